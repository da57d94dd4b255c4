// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/perimeter_file.h"

#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/raster/test/make_raster.h"

namespace skein::environment::perimeter_file_test {
namespace {

using Warnings = std::vector<std::string>;

std::string feature(const std::string& properties, const std::string& geometry) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" +
         geometry + "}";
}

const char* const kTriangle =
    R"({"type":"Polygon","coordinates":[[[-121,38.9],[-120.99,38.9],[-121,38.91],[-121,38.9]]]})";

std::string collection(const std::vector<std::string>& features) {
  std::string text = R"({"type":"FeatureCollection","features":[)";
  for (std::size_t i = 0; i < features.size(); ++i)
    text += (i > 0 ? "," : "") + features[i];
  return text + "]}";
}

std::string written(const std::string& name, const std::string& text) {
  const std::string path = scratch(name);
  std::ofstream(path) << text;
  return path;
}

Result<RawSeries> read(const std::string& text, const std::string& time_field = "") {
  Warnings warnings;
  return read_perimeters(written("p.geojson", text), {.time_field = time_field},
                         warnings);
}

std::string refusal(const std::string& text, const std::string& time_field = "") {
  const auto series = read(text, time_field);
  return series.ok() ? std::string("accepted") : series.error().text();
}

TEST(ReadPerimeters, TakesSecondsAndDates) {
  const auto seconds = read(collection(
      {feature(R"("seconds":0)", kTriangle), feature(R"("seconds":60.5)", kTriangle)}));
  ASSERT_TRUE(seconds.ok()) << seconds.error().text();
  EXPECT_FALSE(seconds.value().utc);
  ASSERT_EQ(seconds.value().perimeters.size(), 2u);
  EXPECT_EQ(seconds.value().perimeters[1].time, 60.5);
  ASSERT_EQ(seconds.value().perimeters[0].polygons.size(), 1u);
  EXPECT_EQ(seconds.value().perimeters[0].polygons[0].outer[1], Vec2(38.9, -120.99));

  const auto dates =
      read(collection({feature(R"("time_local":"2021-09-05T14:04:00-07:00")", kTriangle),
                       feature(R"("time_local":"2021-09-05T21:34:00Z")", kTriangle)}));
  ASSERT_TRUE(dates.ok()) << dates.error().text();
  EXPECT_TRUE(dates.value().utc);
  EXPECT_EQ(dates.value().perimeters[0].time, *parse_utc("2021-09-05T21:04:00Z"));
  EXPECT_EQ(dates.value().perimeters[1].time - dates.value().perimeters[0].time, 1800);
  EXPECT_EQ(refusal(collection({feature(R"("mapped":7)", kTriangle)}), "mapped"),
            "accepted");
}

TEST(ReadPerimeters, TakesEveryKindOfAreaAndLine) {
  Warnings warnings;
  const auto series = read_perimeters(
      written(
          "kinds.geojson",
          collection({feature(R"("seconds":0)",
                              R"({"type":"GeometryCollection","geometries":[
                         {"type":"MultiPolygon","coordinates":[
                           [[[0,0],[1,0],[1,1],[0,0]],[[0.5,0.2],[0.6,0.2],[0.6,0.3],[0.5,0.2]]],
                           [[[2,2],[3,2],[3,3],[2,2]]]]},
                         {"type":"LineString","coordinates":[[0,0],[1,0],[1,1]]},
                         {"type":"MultiLineString","coordinates":[[[0,0],[1,0]],[[1,1],[0,0]]]},
                         {"type":"Point","coordinates":[0,0]}]})"),
                      feature(R"("seconds":1)", R"({"type":"Polygon","coordinates":[]})"),
                      feature(R"("seconds":2)", "null")})),
      {}, warnings);
  ASSERT_TRUE(series.ok()) << series.error().text();
  const RawPerimeter& first = series.value().perimeters[0];
  ASSERT_EQ(first.polygons.size(), 2u);
  EXPECT_EQ(first.polygons[0].holes.size(), 1u);
  EXPECT_EQ(first.lines.size(), 3u);
  // One for the point, one for both without geometry.
  EXPECT_EQ(warnings.size(), 2u) << ::testing::PrintToString(warnings);
}

TEST(ReadPerimeters, RefusesWithTheFileTheFeatureAndTheReason) {
  ::testing::internal::CaptureStderr();
  EXPECT_NE(refusal("").find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal("{").find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal(collection({})).find("no features"), std::string::npos);
  EXPECT_NE(refusal(collection({feature(R"("mapped":7)", kTriangle)})).find("mapped"),
            std::string::npos);
  EXPECT_NE(
      refusal(collection({feature(R"("time":"noon")", kTriangle)})).find("\"noon\""),
      std::string::npos);
  EXPECT_NE(refusal(collection({feature(R"("time":"5")", kTriangle),
                                feature(R"("time":"2021-09-05")", kTriangle)}))
                .find("mixed"),
            std::string::npos);
  EXPECT_NE(
      refusal(collection({feature(
                  R"("time":0)",
                  R"({"type":"Polygon","coordinates":[[[0,0],[1,1e99],[1,0],[0,0]]]})")}))
          .find("no latitude"),
      std::string::npos);
  // Cut in the middle of its text.
  const std::string whole = collection({feature(R"("seconds":0)", kTriangle)});
  EXPECT_NE(refusal(whole.substr(0, whole.size() / 2)), "accepted");
  Warnings warnings;
  EXPECT_EQ(read_perimeters("/no/such", {}, warnings).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ReadPerimeters, NotANumberIsRefused) {
  // GDAL's own reader of well-known text lets NaN pass; so does a shapefile's binary.
  const std::string path = scratch("nan.csv");
  std::ofstream(path) << "WKT,seconds\n\"POLYGON ((0 0,1 nan,1 1,0 0))\",0\n";
  Warnings warnings;
  const auto series = read_vector(path, {}, warnings);
  ASSERT_FALSE(series.ok());
}

TEST(ReadPerimeters, TablesNameTheirFiles) {
  const std::string a = written("a.geojson", collection({feature("", kTriangle)}));
  written("b.geojson", collection({feature("", kTriangle), feature("", kTriangle)}));
  Warnings warnings;
  const auto table = [&](const std::string& text) {
    return read_perimeters(written("t.csv", text), {}, warnings);
  };
  const auto series =
      table("file,time_utc\na.geojson,2021-09-05T21:04Z\nb.geojson,2021-09-05T22:04Z\n");
  ASSERT_TRUE(series.ok()) << series.error().text();
  EXPECT_TRUE(series.value().utc);
  EXPECT_EQ(series.value().perimeters[1].polygons.size(), 2u);
  EXPECT_EQ(series.value().perimeters[1].time - series.value().perimeters[0].time, 3600);
  for (const char* bad :
       {"file,when\na.geojson,0\n", "file,seconds\n", "seconds\n0\n",
        "file,seconds\nnone.geojson,0\n", "file,seconds\na.geojson,soon\n",
        "file,seconds\n,0\n", "n,object_id,seconds\n-1,7,0\n",
        "file,time\na.geojson,5\na.geojson,2021-09-05\n", "file,seconds\nt.csv,0\n"}) {
    const auto refused = table(bad);
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_NE(refused.error().message, "") << bad;
  }
}

TEST(ReadPerimeters, AFolderHoldsATableOrVectorFiles) {
  const std::string one = scratch("folder");
  std::filesystem::create_directories(one);
  Warnings warnings;
  EXPECT_EQ(read_perimeters(one, {}, warnings).error().code, ErrorCode::kNotFound);
  std::ofstream(one + "/a.geojson") << collection({feature(R"("seconds":0)", kTriangle)});
  EXPECT_TRUE(read_perimeters(one, {}, warnings).ok());
  std::filesystem::copy(one + "/a.geojson", one + "/b.geojson");
  EXPECT_EQ(read_perimeters(one, {}, warnings).value().perimeters.size(), 2u);
  std::ofstream(one + "/perimeters.csv") << "file,seconds\nb.geojson,3\n";
  EXPECT_TRUE(read_perimeters(one, {}, warnings).ok());
}

TEST(ReadPerimeters, TakesZippedFilesAndGeodatabases) {
  const std::string zip = scratch("20210905_1404_perimeter.zip");
  std::filesystem::remove(zip);
  const std::string text = collection({feature("", kTriangle)});
  VSILFILE* file = VSIFOpenL(("/vsizip/" + zip + "/perimeter.geojson").c_str(), "wb");
  ASSERT_NE(file, nullptr);
  VSIFWriteL(text.data(), 1, text.size(), file);
  VSIFCloseL(file);
  Warnings warnings;
  const auto zipped = read_perimeters(zip, {}, warnings);
  ASSERT_TRUE(zipped.ok()) << zipped.error().text();
  EXPECT_EQ(zipped.value().perimeters.at(0).time, *parse_utc("2021-09-05T14:04Z"));

  // One layer per flight, as an incident's geodatabase may have it, in metres.
  const std::string base = scratch("incident.gdb");
  std::filesystem::remove_all(base);
  const geo::GdalGuard guard;
  GDALDriverH driver = GDALGetDriverByName("OpenFileGDB");
  ASSERT_NE(driver, nullptr);
  GDALDatasetH dataset = GDALCreate(driver, base.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  if (dataset == nullptr) GTEST_SKIP() << "this library writes no geodatabases";
  OGRSpatialReferenceH utm = OSRNewSpatialReference(nullptr);
  OSRImportFromEPSG(utm, 32610);
  for (const char* name : {"Heat_20210905_1404", "Heat_20210905_1434"}) {
    OGRLayerH layer =
        GDALDatasetCreateLayer(dataset, name, utm, wkbMultiPolygon, nullptr);
    OGRFeatureH each = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    const char* shape =
        "MULTIPOLYGON (((673000 4307000,674000 4307000,674000 4308000,673000 4307000)))";
    std::string wkt = shape;
    char* cursor = wkt.data();
    OGRGeometryH geometry = nullptr;
    OGR_G_CreateFromWkt(&cursor, utm, &geometry);
    OGR_F_SetGeometryDirectly(each, geometry);
    EXPECT_EQ(OGR_L_CreateFeature(layer, each), OGRERR_NONE);
    OGR_F_Destroy(each);
  }
  OSRRelease(utm);
  GDALClose(dataset);
  const auto read = read_perimeters(base, {.utc_offset_h = -7}, warnings);
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(read.value().perimeters.size(), 2u);
  EXPECT_EQ(read.value().perimeters[1].time, *parse_utc("2021-09-05T21:34Z"));
  EXPECT_NEAR(read.value().perimeters[0].polygons.at(0).outer.at(0).x(), 38.895, 0.005);
}

TEST(ReadPerimeters, ATruncatedShapefileIsRefused) {
  const std::string source =
      std::string(SKEIN_SHARED_DATA) + "/fires/bridge_2021/perimeters/";
  if (!std::filesystem::exists(source)) GTEST_SKIP() << "no " << source;
  const std::string copy = scratch("cut.shp");
  for (const char* kind : {"shp", "shx", "dbf", "prj"}) {
    const std::string to = copy.substr(0, copy.size() - 3) + kind;
    std::filesystem::remove(to);
    std::filesystem::copy(source + "02_163234." + kind, to);
  }
  const std::string table = written("t.csv", "file,seconds\ncut.shp,0\n");
  Warnings warnings;
  ASSERT_TRUE(read_perimeters(table, {}, warnings).ok());
  cut_file(copy, 0.5);
  ::testing::internal::CaptureStderr();
  const auto refused = read_perimeters(table, {}, warnings);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(refused.ok());
}

}  // namespace
}  // namespace skein::environment::perimeter_file_test
