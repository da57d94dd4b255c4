#include "skein/layer/environment/recorded/perimeter_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "skein/layer/environment/raster/csv_table.h"
#include "skein/layer/environment/raster/utc_time.h"
#include "skein/layer/environment/recorded/vector_layer.h"

namespace skein::environment {
namespace {

namespace fs = std::filesystem;

Error mixed_times(const std::string& place) {
  return {
      ErrorCode::kBadInput, place,
      "has a time of another kind than the ones before it: seconds and dates are mixed",
      ""};
}

struct TableTime {
  double value;
  bool utc;
};

Result<TableTime> table_time(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string& text = table.text(row, column);
  if (const auto number = parse_number(text); number && std::abs(*number) < 1e12)
    return TableTime{*number, false};
  if (const auto utc = parse_utc(text)) return TableTime{*utc, true};
  return Error{ErrorCode::kBadInput, table.place(row),
               fmt::format("column {}: \"{}\" is no time", table.names()[column], text),
               "seconds or ISO 8601 are allowed"};
}

// Where the table says the perimeter of a row is.
Result<std::string> row_file(const CsvTable& table, std::size_t row,
                             const fs::path& path) {
  if (const auto file = table.column("file")) {
    if (table.text(row, *file).empty())
      return Error{ErrorCode::kBadInput, table.place(row), "column file: is empty", ""};
    return (path.parent_path() / table.text(row, *file)).string();
  }
  const auto n = table.column("n"), object = table.column("object_id");
  if (!n || !object)
    return Error{ErrorCode::kBadInput, path.string(),
                 "does not name the perimeters' files",
                 "a column file, or columns n and object_id, are needed"};
  const auto number = table.number(row, *n);
  if (!number) return number.error();
  if (!(number.value() >= 0 && number.value() < 1e6))
    return Error{ErrorCode::kBadInput, table.place(row),
                 fmt::format("column n: {} is outside 0 to 999999", number.value()), ""};
  return (path.parent_path() / path.stem() /
          fmt::format("{:02}_{}.shp", static_cast<int>(number.value()),
                      table.text(row, *object)))
      .string();
}

Result<RawSeries> read_table(const std::string& path, const std::string& time_field,
                             std::vector<std::string>& warnings) {
  const auto loaded = CsvTable::load(path);
  if (!loaded) return loaded.error();
  const CsvTable& table = loaded.value();
  std::optional<std::size_t> time;
  if (!time_field.empty()) {
    time = table.column(time_field);
  } else {
    for (const std::string& name : time_names())
      if (!time) time = table.column(name);
  }
  if (!time)
    return Error{ErrorCode::kBadInput, path, "has no column with a time",
                 "for example seconds or time_utc"};
  if (table.size() == 0)
    return Error{ErrorCode::kBadInput, path, "has a header but no rows", ""};
  RawSeries series;
  VectorReader reader;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto at = table_time(table, row, *time);
    if (!at) return at.error();
    if (row > 0 && at.value().utc != series.utc) return mixed_times(table.place(row));
    series.utc = at.value().utc;
    const auto file = row_file(table, row, path);
    if (!file) return file.error();
    std::error_code ignored;
    if (!fs::exists(file.value(), ignored))
      return Error{ErrorCode::kNotFound, table.place(row),
                   "there is no file " + file.value(), ""};
    auto features = reader.read(file.value(), "", false, warnings);
    if (!features) return features.error();
    RawPerimeter whole{at.value().value, file.value(), {}, {}};
    for (VectorFeature& feature : features.value()) {
      std::move(feature.outline.polygons.begin(), feature.outline.polygons.end(),
                std::back_inserter(whole.polygons));
      std::move(feature.outline.lines.begin(), feature.outline.lines.end(),
                std::back_inserter(whole.lines));
    }
    series.perimeters.push_back(std::move(whole));
  }
  return series;
}

Result<std::string> file_in_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "perimeters.csv", error))
    return (folder / "perimeters.csv").string();
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string kind = entry.path().extension().string();
    for (const char* known :
         {".geojson", ".json", ".shp", ".gpkg", ".kml", ".kmz", ".gml"})
      if (kind == known) found.push_back(entry.path().string());
  }
  if (error)
    return Error{ErrorCode::kUnavailable, folder.string(),
                 "cannot be listed: " + error.message(), ""};
  if (found.size() == 1) return found[0];
  return Error{ErrorCode::kNotFound, folder.string(),
               fmt::format("holds no perimeters.csv and {} vector files", found.size()),
               "give the file, or a folder with perimeters.csv or one vector file"};
}

}  // namespace

Result<RawSeries> read_vector(const std::string& name, const std::string& time_field,
                              std::vector<std::string>& warnings) {
  auto features = VectorReader().read(name, time_field, true, warnings);
  if (!features) return features.error();
  RawSeries series;
  for (std::size_t i = 0; i < features.value().size(); ++i) {
    VectorFeature& feature = features.value()[i];
    const bool utc = feature.utc.has_value();
    if (i > 0 && utc != series.utc) return mixed_times(feature.outline.place);
    series.utc = utc;
    feature.outline.time = utc ? *feature.utc : *feature.number;
    series.perimeters.push_back(std::move(feature.outline));
  }
  return series;
}

Result<RawSeries> read_perimeters(const std::string& path, const std::string& time_field,
                                  std::vector<std::string>& warnings) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    return Error{ErrorCode::kNotFound, path, "there is no such file or folder", ""};
  std::string file = path;
  if (fs::is_directory(path, ignored)) {
    const auto found = file_in_folder(path);
    if (!found) return found.error();
    file = found.value();
  }
  if (fs::path(file).extension() == ".csv") return read_table(file, time_field, warnings);
  return read_vector(file, time_field, warnings);
}

}  // namespace skein::environment
