// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/fire_features.h"

#include <gtest/gtest.h>

#include <fstream>

#include "skein/layer/environment/raster/date_time.h"

namespace skein::environment::fire_features_test {
namespace {

// A feature with an area, as the reader gives it.
VectorFeature area_of(std::vector<Attribute> attributes,
                      const std::string& layer = "perimeters",
                      const std::string& file = "fires.gpkg") {
  VectorFeature feature;
  feature.layer = layer;
  feature.attributes = std::move(attributes);
  feature.outline.place = file + ": feature 0";
  feature.outline.polygons.push_back(
      {{{38.9, -121}, {38.9, -120.99}, {38.91, -121}}, {}});
  return feature;
}

VectorFeature line_of(std::vector<Attribute> attributes, const std::string& layer) {
  VectorFeature feature = area_of(std::move(attributes), layer);
  feature.outline.lines.push_back(feature.outline.polygons[0].outer);
  feature.outline.polygons.clear();
  return feature;
}

struct Read {
  std::vector<double> times;
  std::string notes, error;
};

Read read_features(std::vector<VectorFeature> features,
                   const PerimeterFileOptions& options = {}) {
  std::vector<std::string> warnings;
  const auto series = dated_perimeters(std::move(features), "fire", options, warnings);
  Read result;
  for (const std::string& each : warnings) result.notes += each + "\n";
  if (!series) {
    result.error = series.error().text();
    return result;
  }
  for (const RawPerimeter& each : series.value().perimeters)
    result.times.push_back(each.time);
  return result;
}

double moment(const char* text) {
  return *parse_utc(text);
}

using Moments = std::vector<double>;

TEST(FireFeatures, TakeTheTimeOfThePerimeterNotOfTheRecord) {
  // As the interagency service gives GeoJSON: milliseconds, prefixed names.
  const Read geojson =
      read_features({area_of({{"poly_CreateDate", "1630900000000"},
                              {"poly_PolygonDateTime", "1630850640000"}}),
                     area_of({{"poly_CreateDate", "1630900000000"},
                              {"poly_PolygonDateTime", "1630852440000"}})});
  EXPECT_EQ(geojson.times,
            (Moments{moment("2021-09-05T14:04Z"), moment("2021-09-05T14:34Z")}))
      << geojson.error;
  EXPECT_NE(
      geojson.notes.find("times are in poly_PolygonDateTime (not in poly_CreateDate)"),
      std::string::npos)
      << geojson.notes;
  // The same as a shapefile: names cut to ten letters, dates without time.
  const Read shapefile = read_features(
      {area_of({{"poly_Polyg", "2021-09-05"}}), area_of({{"poly_Polyg", "2021-09-06"}})});
  EXPECT_EQ(shapefile.times, (Moments{moment("2021-09-05"), moment("2021-09-06")}))
      << shapefile.error;
  EXPECT_NE(shapefile.notes.find("dates without a time of day are 00:00"),
            std::string::npos);
}

TEST(FireFeatures, TakeDateAndTimeFromTwoAttributes) {
  const Read read =
      read_features({area_of({{"ACQ_DATE", "2021-09-05"}, {"ACQ_TIME", "904"}}),
                     area_of({{"ACQ_DATE", "2021-09-05"}, {"ACQ_TIME", "2130"}})});
  EXPECT_EQ(read.times,
            (Moments{moment("2021-09-05T09:04Z"), moment("2021-09-05T21:30Z")}))
      << read.error;
  const Read plain =
      read_features({area_of({{"date", "2021-09-05"}, {"time", "14:04"}})});
  EXPECT_EQ(plain.times, (Moments{moment("2021-09-05T14:04Z")})) << plain.error;
}

TEST(FireFeatures, TakeTimesFromNamesOfLayersAndFiles) {
  const Read layers = read_features({area_of({}, "Heat Perimeter 20210905 1404"),
                                     area_of({}, "Heat Perimeter 20210905 2300")},
                                    {.utc_offset_h = -7});
  EXPECT_EQ(layers.times,
            (Moments{moment("2021-09-05T21:04Z"), moment("2021-09-06T06:00Z")}))
      << layers.error;
  EXPECT_NE(layers.notes.find("layers' names"), std::string::npos) << layers.notes;
  EXPECT_EQ(layers.notes.find("UTC"), std::string::npos) << layers.notes;
  const Read files =
      read_features({area_of({}, "perimeter", "fire/20210905_1404_perimeter.zip"),
                     area_of({}, "perimeter", "fire/20210905_1434_perimeter.zip")});
  EXPECT_EQ(files.times.size(), 2u) << files.error;
  EXPECT_NE(files.notes.find("files' names"), std::string::npos) << files.notes;
}

TEST(FireFeatures, TakeTheDatesThatDifferUnderNamesNobodyKnows) {
  const Read read = read_features(
      {area_of(
           {{"id", "20210905"}, {"vu_le", "2021-09-05 14:04"}, {"debut", "2021-09-01"}}),
       area_of({{"id", "20210906"},
                {"vu_le", "2021-09-05 14:34"},
                {"debut", "2021-09-01"}})});
  ASSERT_EQ(read.times.size(), 2u) << read.error;
  EXPECT_EQ(read.times[1] - read.times[0], 1800);
  EXPECT_NE(read.notes.find("times are in vu_le, the dates that differ most"),
            std::string::npos)
      << read.notes;
}

TEST(FireFeatures, SayInWhichOrderDatesAreRead) {
  const Read shown =
      read_features({area_of({{"date", "5/9/2021"}}), area_of({{"date", "25/9/2021"}})});
  EXPECT_EQ(shown.times, (Moments{moment("2021-09-05"), moment("2021-09-25")}));
  EXPECT_NE(shown.notes.find("the day stands before the month, as \"25/9/2021\" shows"),
            std::string::npos)
      << shown.notes;
  const Read open = read_features({area_of({{"date", "5/9/2021"}})});
  EXPECT_EQ(open.times, (Moments{moment("2021-05-09")}));
  EXPECT_NE(open.notes.find("the month stands before the day"), std::string::npos);
}

TEST(FireFeatures, FillEmptyTimesFromTheNextKnownAttribute) {
  const auto feature = [](const char* seen, const char* current) {
    return area_of({{"poly_PolygonDateTime", seen}, {"poly_DateCurrent", current}});
  };
  const Read read =
      read_features({feature("2021-09-05T10:00:00Z", "1630836000000"),
                     feature("", "1630839600000"), feature("", "-2209161600000")});
  EXPECT_EQ(read.times,
            (Moments{moment("2021-09-05T10:00Z"), moment("2021-09-05T11:00Z")}))
      << read.error;
  EXPECT_NE(read.notes.find("1 time(s) are from poly_DateCurrent"), std::string::npos)
      << read.notes;
  EXPECT_NE(read.notes.find("such as \"-2209161600000\""), std::string::npos)
      << read.notes;
  EXPECT_NE(read.notes.find("1 feature(s) without a time left out"), std::string::npos);
}

TEST(FireFeatures, LeaveOutDatesThatMeanNone) {
  const Read read = read_features({area_of({{"poly_DateCurrent", "0"}}),
                                   area_of({{"poly_DateCurrent", "1630839600000"}}),
                                   area_of({{"poly_DateCurrent", "1630843200000"}})});
  EXPECT_EQ(read.times,
            (Moments{moment("2021-09-05T11:00Z"), moment("2021-09-05T12:00Z")}))
      << read.error;
  EXPECT_NE(read.notes.find("mean that there is no time, such as \"0\""),
            std::string::npos)
      << read.notes;
}

TEST(FireFeatures, TakeTheOrderOfDatesThatIsGiven) {
  const std::vector<VectorFeature> all = {area_of({{"FIREDATE", "05/09/2021"}}),
                                          area_of({{"FIREDATE", "06/09/2021"}})};
  EXPECT_EQ(read_features(all).times,
            (Moments{moment("2021-09-05"), moment("2021-09-06")}));
  EXPECT_EQ(read_features(all, {.date_order = DateOrder::kMonthFirst}).times,
            (Moments{moment("2021-05-09"), moment("2021-06-09")}));
}

TEST(FireFeatures, KeepPerimetersOfOneIncidentOnly) {
  const auto feature = [](const char* name, const char* time) {
    return area_of({{"poly_IncidentName", name}, {"time", time}});
  };
  const std::vector<VectorFeature> all = {feature("Bridge", "2021-09-05T14:04Z"),
                                          feature("River", "2021-08-04T16:36Z"),
                                          feature("BRIDGE ", "2021-09-05T14:34Z")};
  const Read several = read_features(all);
  EXPECT_NE(several.error.find("holds 2 incidents"), std::string::npos) << several.error;
  EXPECT_NE(several.error.find("BRIDGE (2), RIVER (1)"), std::string::npos);
  EXPECT_EQ(read_features(all, {.incident = "bridge"}).times.size(), 2u);
  EXPECT_NE(read_features(all, {.incident = "Dixie"}).error.find("no incident \"Dixie\""),
            std::string::npos);

  const Read categories = read_features(
      {area_of({{"FeatureCategory", "Wildfire Daily Fire Perimeter"}, {"time", "0"}}),
       area_of({{"FeatureCategory", "Temporary Flight Restriction"}, {"time", "1"}}),
       area_of({{"DeleteThis", "Yes"}, {"time", "2"}}),
       line_of({{"FeatureCategory", "Completed Dozer Line"}, {"time", "3"}}, "lines")});
  EXPECT_EQ(categories.times, (Moments{0})) << categories.error;
  EXPECT_NE(categories.notes.find("2 feature(s) left out: of another category"),
            std::string::npos)
      << categories.notes;
  EXPECT_EQ(read_features({area_of({{"time", "0"}}), line_of({{"time", "0"}}, "lines")})
                .times.size(),
            1u);
}

TEST(FireFeatures, LeaveOutWhatHasNoTimeAndSaySo) {
  const Read some = read_features(
      {area_of({{"polygondatetime", "2021-09-05T14:04Z"}}), area_of({{"name", "old"}})});
  EXPECT_EQ(some.times.size(), 1u) << some.error;
  EXPECT_NE(some.notes.find("1 feature(s) without a time"), std::string::npos)
      << some.notes;
  EXPECT_NE(
      read_features({area_of({{"name", "old"}})}).error.find("no attribute with a time"),
      std::string::npos);
}

}  // namespace
}  // namespace skein::environment::fire_features_test
