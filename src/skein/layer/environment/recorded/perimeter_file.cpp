// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/perimeter_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "skein/base/csv.h"
#include "skein/geo/gdal/gdal_guard.h"
#include "skein/geo/gdal/vector_files.h"
#include "skein/layer/environment/raster/date_column.h"
#include "skein/layer/environment/recorded/feature_times.h"
#include "skein/layer/environment/recorded/fire_features.h"
#include "skein/layer/environment/recorded/vector_layer.h"

namespace skein::environment {
namespace {

namespace fs = std::filesystem;

// The times of all rows; none for rows that have none.
Result<std::vector<std::optional<DateTime>>> table_times(
    const CsvTable& table, std::size_t column, const std::string& path,
    const PerimeterFileOptions& options, std::vector<std::string>& warnings) {
  const std::string& name = table.names()[column];
  std::vector<std::string> texts;
  for (std::size_t row = 0; row < table.size(); ++row)
    texts.push_back(table.text(row, column));
  DateColumn dates = read_date_column(
      texts, name,
      {.order = options.date_order, .plain_seconds = is_plain_seconds(name)});
  if (dates.wrong)
    return Error{ErrorCode::kBadInput, table.place(*dates.wrong),
                 fmt::format("column {}: \"{}\" is no time", name, texts[*dates.wrong]),
                 "seconds or ISO 8601 are allowed"};
  for (const std::string& line : dates.understood)
    warnings.push_back(fmt::format("{}: assumed: {}", path, line));
  std::size_t none = 0;
  for (auto& time : dates.times) {
    if (!time)
      ++none;
    else if (!time->zone)
      time->value -= 3600 * options.utc_offset_h;
  }
  if (none == table.size())
    return Error{ErrorCode::kBadInput, path, fmt::format("column {} has no time", name),
                 "seconds or ISO 8601 are allowed"};
  if (none > 0)
    warnings.push_back(fmt::format("{}: {} row(s) without a time left out{}", path, none,
                                   dates.null_count > 0
                                       ? fmt::format(", such as \"{}\"", dates.first_null)
                                       : std::string()));
  return std::move(dates.times);
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

Result<RawSeries> read_table(const std::string& path, const PerimeterFileOptions& options,
                             std::vector<std::string>& warnings) {
  const auto loaded = CsvTable::load(path);
  if (!loaded) return loaded.error();
  const CsvTable& table = loaded.value();
  std::vector<std::string_view> used = {"file", "n", "object_id"};
  if (!options.time_field.empty()) used.push_back(options.time_field);
  const auto names = time_names();
  used.insert(used.end(), names.begin(), names.end());
  if (auto unique = table.check_unique(used); !unique) return unique.error();
  std::optional<std::size_t> time;
  if (!options.time_field.empty()) {
    time = table.column(options.time_field);
  } else {
    for (const std::string_view name : time_names())
      if (!time) time = table.column(name);
  }
  if (!time)
    return Error{ErrorCode::kBadInput, path, "has no column with a time",
                 "for example seconds or time_utc"};
  if (table.size() == 0)
    return Error{ErrorCode::kBadInput, path, "has a header but no rows", ""};
  const auto times = table_times(table, *time, path, options, warnings);
  if (!times) return times.error();
  RawSeries series;
  VectorReader reader;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto& at = times.value()[row];
    if (!at) continue;
    if (!series.perimeters.empty() && at->utc != series.utc)
      return mixed_times(table.place(row));
    series.utc = at->utc;
    const auto file = row_file(table, row, path);
    if (!file) return file.error();
    std::error_code ignored;
    if (!fs::exists(file.value(), ignored))
      return Error{ErrorCode::kNotFound, table.place(row),
                   "there is no file " + file.value(), ""};
    auto features = reader.read(file.value(), warnings);
    if (!features) return features.error();
    RawPerimeter whole{at->value, file.value(), {}, {}};
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

// All vector files of a folder, in the order of their names.
Result<std::vector<std::string>> files_in_folder(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_vector_name(entry.path())) found.push_back(entry.path().string());
  if (error)
    return Error{ErrorCode::kUnavailable, folder.string(),
                 "cannot be listed: " + error.message(), ""};
  if (found.empty())
    return Error{ErrorCode::kNotFound, folder.string(),
                 "holds no perimeters.csv and no vector files",
                 "docs/environment.md has the formats that can be read"};
  std::sort(found.begin(), found.end());
  return found;
}

Result<std::vector<VectorFeature>> read_files(const std::vector<std::string>& files,
                                              std::vector<std::string>& warnings) {
  VectorReader reader;
  std::vector<VectorFeature> all;
  for (const std::string& file : files) {
    const auto datasets = [&] {
      const geo::GdalGuard guard;
      return geo::vector_datasets(file);
    }();
    for (const std::string& dataset : datasets) {
      auto features = reader.read(dataset, warnings);
      if (!features) return features.error();
      std::move(features.value().begin(), features.value().end(),
                std::back_inserter(all));
    }
  }
  return all;
}

}  // namespace

bool is_vector_name(const fs::path& path) {
  return geo::is_vector_name(path);
}

Result<RawSeries> read_vector(const std::string& name,
                              const PerimeterFileOptions& options,
                              std::vector<std::string>& warnings) {
  auto features = read_files({name}, warnings);
  if (!features) return features.error();
  return dated_perimeters(std::move(features).value(), name, options, warnings);
}

Result<RawSeries> read_perimeters(const std::string& path,
                                  const PerimeterFileOptions& options,
                                  std::vector<std::string>& warnings) {
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    return Error{ErrorCode::kNotFound, path, "there is no such file or folder", ""};
  if (geo::small_ending(path) == ".csv") return read_table(path, options, warnings);
  if (!fs::is_directory(path, ignored) || is_vector_name(path))
    return read_vector(path, options, warnings);
  const fs::path table = fs::path(path) / "perimeters.csv";
  if (fs::exists(table, ignored)) return read_table(table.string(), options, warnings);
  const auto files = files_in_folder(path);
  if (!files) return files.error();
  auto features = read_files(files.value(), warnings);
  if (!features) return features.error();
  return dated_perimeters(std::move(features).value(), path, options, warnings);
}

}  // namespace skein::environment
