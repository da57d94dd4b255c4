// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/whole_file.h"

#include "skein/base/random.h"
#include "skein/layer/environment/raster/raster_file.h"
#include "skein/layer/environment/raster/test/make_raster.h"

namespace skein::environment::whole_file_test {
namespace {

// Two bands of a place near the equator, in any format.
RasterRecipe recipe_for(const char* driver, std::vector<const char*> create = {}) {
  RasterRecipe recipe;
  recipe.driver = driver;
  recipe.create = std::move(create);
  recipe.columns = 50;
  recipe.rows = 40;
  recipe.epsg = 4326;
  recipe.type = GDT_Float32;  // the widest that all formats have
  recipe.geo = {10, 0.01, 0, 2, 0, -0.01};
  recipe.bands = {std::vector<double>(2000), std::vector<double>(2000)};
  for (std::size_t i = 0; i < 2000; ++i) {
    recipe.bands[0][i] = 3 + 0.1 * static_cast<double>(i % 17);
    recipe.bands[1][i] = 200 + static_cast<double>(i % 31);
  }
  return recipe;
}

// What reading both bands over their middle says; empty when both can be read.
std::string refusal(const std::string& path, const char* variable = "") {
  const auto frame = geo::LocalFrame::at({1.8, 10.25, 0}).value();
  const GridShape shape{Vec2(-10000, -10000), 1000, 21, 21};
  const auto file = RasterFile::open(path, variable);
  if (!file) return file.error().text();
  const auto map = file.value().map(frame, shape);
  if (!map) return map.error().text();
  if (file.value().bands().empty()) return "no band";
  for (const BandInfo& band : file.value().bands()) {
    const auto pixels = file.value().read(band.number, map.value().window());
    if (!pixels) return pixels.error().text();
    for (const double value : pixels.value().values)
      if (!(value > 2.9)) return "WRONG VALUE " + std::to_string(value);
  }
  return "";
}

struct Format {
  const char* name;
  RasterRecipe recipe;
  const char* variable;
};

std::vector<Format> formats() {
  return {{"cdf1.nc", recipe_for("netCDF", {"FORMAT=NC"}), "Band1"},
          {"cdf2.nc", recipe_for("netCDF", {"FORMAT=NC2"}), "Band1"},
          {"hdf5.nc", recipe_for("netCDF", {"FORMAT=NC4"}), "Band1"},
          {"hdf5c.nc", recipe_for("netCDF", {"FORMAT=NC4C"}), "Band1"},
          {"grib2.grb", recipe_for("GRIB"), ""},
          {"tiff.tif", recipe_for("GTiff"), ""},
          {"envi.dat", recipe_for("ENVI"), ""}};
}

TEST(WholeFile, EveryCutIsSeenInEveryFormat) {
  ::testing::internal::CaptureStderr();
  for (const Format& format : formats()) {
    const std::string whole = scratch(format.name);
    make_raster(whole, format.recipe);
    ASSERT_EQ(refusal(whole, format.variable), "") << format.name;
    const auto size = std::filesystem::file_size(whole);
    for (std::uintmax_t part = 1; part <= 11; ++part) {
      const std::string cut = scratch("cut-" + std::string(format.name));
      std::filesystem::copy_file(whole, cut);
      const auto header = std::filesystem::path(whole).replace_extension(".hdr");
      if (std::filesystem::exists(header))  // of ENVI
        std::filesystem::copy_file(header,
                                   std::filesystem::path(cut).replace_extension(".hdr"),
                                   std::filesystem::copy_options::overwrite_existing);
      // Elevenths: half of a GRIB file of two messages is a whole file of one. The last
      // cut is one of a few bytes; mere padding at the very end may be missing.
      std::filesystem::resize_file(cut, part < 11 ? size * part / 11 : size - 8);
      const std::string text = refusal(cut, format.variable);
      EXPECT_NE(text, "") << format.name << ", part " << part;
      EXPECT_EQ(text.find("WRONG"), std::string::npos) << format.name << ": " << text;
    }
  }
  ::testing::internal::GetCapturedStderr();  // what PROJ and HDF5 say of their own
}

// The libraries that read these formats crash on some of them.
TEST(WholeFile, DamageNeverEndsTheProcess) {
  RandomStream random(29, 0, Purpose::kTest);
  const auto below = [&](std::size_t count) { return random.bits() % count; };
  for (const Format& format : formats()) {
    const std::string whole = scratch(format.name);
    make_raster(whole, format.recipe);
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const std::string damaged = scratch("damaged-" + std::string(format.name));
    const auto header = std::filesystem::path(whole).replace_extension(".hdr");
    if (std::filesystem::exists(header))  // of ENVI
      std::filesystem::copy_file(
          header, std::filesystem::path(damaged).replace_extension(".hdr"));
    for (int k = 0; k < 60; ++k) {
      std::string copy = bytes;
      // Most of them where the header is.
      for (std::size_t flips = 1 + below(8); flips > 0; --flips)
        copy[below(below(4) == 0 ? copy.size()
                                 : std::min<std::size_t>(copy.size(), 1500))] =
            static_cast<char>(below(3) == 0 ? 255 : random.bits());
      std::ofstream(damaged, std::ios::binary) << copy;
      refusal(damaged, format.variable);
    }
  }
}

TEST(WholeFile, SaysHowMuchIsMissing) {
  const std::string path = scratch("cdf1.nc");
  make_raster(path, recipe_for("netCDF", {"FORMAT=NC"}));
  cut_file(path, 0.9);
  EXPECT_NE(refusal(path).find("is truncated: "), std::string::npos) << refusal(path);
}

// Big-endian numbers and texts as a NetCDF header has them.
struct Writer {
  std::string bytes;
  void number(std::uint64_t value, int size) {
    for (int i = size - 1; i >= 0; --i)
      bytes += static_cast<char>(value >> (8 * i) & 255);
  }
};

// The header, about 160 bytes long, of a file of version 1, 2 or 5 with a record
// dimension and two record variables, one of bytes (padded from 3 to 4 in each record)
// and one of doubles, then `data` zeros.
std::string record_file(const std::string& name, int version, std::uint64_t records,
                        std::size_t data) {
  const int count = version == 5 ? 8 : 4, offset = version == 1 ? 4 : 8;
  Writer w;
  w.bytes = std::string("CDF") + static_cast<char>(version);
  w.number(records, count);
  const auto text = [&](const std::string& t) {
    w.number(t.size(), count);
    w.bytes += t;
    w.bytes.resize((w.bytes.size() + 3) / 4 * 4);
  };
  const auto list = [&](std::uint64_t tag, std::uint64_t n) {
    w.number(tag, 4);
    w.number(n, count);
  };
  list(10, 2);
  text("time");
  w.number(0, count);
  text("x");
  w.number(3, count);
  list(12, 1);
  text("title");
  w.number(2, 4);
  text("wind");
  list(11, 2);
  for (const auto& [variable, type, size, begin] :
       {std::tuple{"a", 1, 4, 1000}, std::tuple{"bb", 6, 24, 1004}}) {
    text(variable);
    w.number(2, count);
    w.number(0, count);
    w.number(1, count);
    list(0, 0);
    w.number(static_cast<std::uint64_t>(type), 4);
    w.number(static_cast<std::uint64_t>(size), count);
    w.number(static_cast<std::uint64_t>(begin), offset);
  }
  w.bytes.resize(1000 + data);
  const std::string path = scratch(name);
  std::ofstream(path, std::ios::binary) << w.bytes;
  return path;
}

TEST(WholeFile, RecordsOfClassicNetcdfCountInAllVersions) {
  constexpr std::size_t kRecord = 28;  // 4 of the padded bytes, 24 of three doubles
  for (const int version : {1, 2, 5}) {
    EXPECT_TRUE(
        check_whole(record_file("r.nc", version, 5, 5 * kRecord), "netCDF", 0).ok())
        << version;
    const auto cut =
        check_whole(record_file("r.nc", version, 5, 5 * kRecord - 1), "netCDF", 0);
    ASSERT_FALSE(cut.ok()) << version;
    EXPECT_NE(cut.error().text().find("1139 bytes long, and its header asks for 1140"),
              std::string::npos)
        << cut.error().text();
    EXPECT_TRUE(check_whole(record_file("r.nc", version, 0, 0), "netCDF", 0).ok());
    // A writer that streams does not know the number of records.
    const std::uint64_t unknown = version == 5 ? ~0ULL : 0xFFFFFFFF;
    EXPECT_TRUE(check_whole(record_file("r.nc", version, unknown, 9), "netCDF", 0).ok());
    // A number of records that no file can hold.
    EXPECT_FALSE(
        check_whole(record_file("r.nc", version, 0xFFFFFFF0, 9), "netCDF", 0).ok());
  }
}

TEST(WholeFile, AHeaderOfNonsenseIsRefused) {
  const std::string path = record_file("r.nc", 1, 5, 140);
  for (std::size_t length = 5; length < 160; length += 7) {
    std::ifstream in(path, std::ios::binary);
    std::string bytes(1140, '\0');
    in.read(bytes.data(), 1140);
    for (std::size_t i = length; i < bytes.size(); ++i) bytes[i] = '\xFF';
    const std::string bad = scratch("bad.nc");
    std::ofstream(bad, std::ios::binary) << bytes;
    EXPECT_FALSE(check_whole(bad, "netCDF", 0).ok()) << length;
  }
}

TEST(WholeFile, MessagesOfGribMayHaveOtherBytesBetweenThem) {
  const std::string path = scratch("two.grb");
  make_raster(path, recipe_for("GRIB"));
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::string bulletin = scratch("bulletin.grb");
  std::ofstream(bulletin, std::ios::binary) << "HEADER\r\n"
                                            << bytes << "GRI more\r\n"
                                            << bytes << "\r\n";
  EXPECT_TRUE(check_whole(bulletin, "GRIB", 0).ok());
  std::filesystem::resize_file(bulletin, std::filesystem::file_size(bulletin) - 12);
  EXPECT_FALSE(check_whole(bulletin, "GRIB", 0).ok());
}

TEST(WholeFile, TheNdfdForecastIsWholeAndNoPartOfItIsTaken) {
  const std::string file = std::string(SKEIN_SHARED_DATA) + "/wind/ndfd_20170603T1800.nc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  EXPECT_TRUE(check_whole(file, "netCDF", 0).ok());
  for (const unsigned length : {60'000u, 80'000u, 100'000u, 150'000u, 184'700u}) {
    const std::string cut = scratch("cut.nc");
    std::filesystem::copy_file(file, cut);
    std::filesystem::permissions(cut, std::filesystem::perms::owner_all);
    std::filesystem::resize_file(cut, length);
    const auto opened = RasterFile::open(cut, "Wind_speed_height_above_ground");
    ASSERT_FALSE(opened.ok()) << length;
    EXPECT_NE(opened.error().text().find("truncated"), std::string::npos)
        << opened.error().text();
  }
}

}  // namespace
}  // namespace skein::environment::whole_file_test
