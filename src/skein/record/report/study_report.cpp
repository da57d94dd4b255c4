// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/study_report.h"

#include <nlohmann/json.hpp>

#include "skein/base/check.h"
#include "skein/record/report/page.h"

namespace skein::record {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json cell_json(const TableCell& cell) {
  Json json;
  if (const auto* text = std::get_if<std::string>(&cell.value))
    json["text"] = *text;
  else
    json["number"] = std::get<double>(cell.value);
  if (cell.highlight) json["highlight"] = true;
  return json;
}

Json table_json(const StudyTable& table) {
  Json rows = Json::array();
  for (const auto& row : table.rows) {
    SKEIN_CHECK(row.size() == table.columns.size(), table.title, row.size());
    Json cells = Json::array();
    for (const TableCell& cell : row) cells.push_back(cell_json(cell));
    rows.push_back(std::move(cells));
  }
  return {{"title", table.title},
          {"caption", table.caption},
          {"columns", table.columns},
          {"rows", std::move(rows)}};
}

Json series_json(const StudySeries& series) {
  SKEIN_CHECK(series.x.size() == series.y.size(), series.name, series.x.size());
  SKEIN_CHECK(series.low.size() == series.high.size(), series.name, series.low.size());
  Json json = {{"name", series.name}, {"x", series.x}, {"y", series.y}};
  if (!series.low.empty()) {
    SKEIN_CHECK(series.low.size() == series.x.size(), series.name, series.low.size());
    json["low"] = series.low;
    json["high"] = series.high;
  }
  if (series.dashed) json["dashed"] = true;
  if (series.points) json["points"] = true;
  return json;
}

Json dots_json(const StudyDots& plot) {
  SKEIN_CHECK(plot.dots.size() == plot.rows.size(), plot.title, plot.dots.size());
  Json rows = Json::array();
  for (const auto& row : plot.dots) {
    SKEIN_CHECK(row.size() == plot.series.size(), plot.title, row.size());
    Json dots = Json::array();
    for (const StudyDot& dot : row)
      dots.push_back(Json::array({dot.value, dot.low, dot.high}));
    rows.push_back(std::move(dots));
  }
  return {{"title", plot.title}, {"caption", plot.caption}, {"x_label", plot.x_label},
          {"log_x", plot.log_x}, {"rows", plot.rows},       {"series", plot.series},
          {"dots", rows}};
}

Json plot_json(const StudyPlot& plot) {
  Json series = Json::array(), levels = Json::array();
  for (const StudySeries& one : plot.series) series.push_back(series_json(one));
  for (const StudyLevel& level : plot.levels)
    levels.push_back({{"y", level.y}, {"label", level.label}});
  return {{"title", plot.title},     {"caption", plot.caption}, {"x_label", plot.x_label},
          {"y_label", plot.y_label}, {"log_x", plot.log_x},     {"log_y", plot.log_y},
          {"series", series},        {"lines", levels},         {"y_low", plot.y_low},
          {"y_high", plot.y_high}};
}

Json map_json(const StudyMap& map) {
  Json series = Json::array();
  for (const StudySeries& one : map.series) series.push_back(series_json(one));
  return {{"title", map.title}, {"caption", map.caption}, {"series", std::move(series)}};
}

}  // namespace

Result<void> write_study_report(const StudyReport& report,
                                const std::filesystem::path& html) {
  Json tables = Json::array(), plots = Json::array(), dots = Json::array(),
       maps = Json::array();
  for (const StudyTable& table : report.tables) tables.push_back(table_json(table));
  for (const StudyPlot& plot : report.plots) plots.push_back(plot_json(plot));
  for (const StudyDots& plot : report.dots) dots.push_back(dots_json(plot));
  for (const StudyMap& map : report.maps) maps.push_back(map_json(map));
  const Json data = {{"page", "study"},         {"title", report.title},
                     {"intro", report.intro},   {"tables", std::move(tables)},
                     {"dots", std::move(dots)}, {"plots", std::move(plots)},
                     {"maps", std::move(maps)}, {"alert", report.alert},
                     {"notes", report.notes}};
  return write_page(PageKind::kStudy, report.title, data, html);
}

}  // namespace skein::record
