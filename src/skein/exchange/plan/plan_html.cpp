// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "skein/exchange/plan/page_assets.h"
#include "skein/exchange/plan/plan_picture.h"
#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/exchange/table/writers.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

constexpr double kMapWidth = 1160, kMapHeight = 760;  // of the map [px]
constexpr std::size_t kMaxRows = 5000;                // of a table

std::string map_part(const Document& document) {
  const MapView view = view_of(document, kMapWidth, kMapHeight);
  const auto [signs, height] = legend(document, kMapWidth);
  return fmt::format(
      "<section>\n<svg class=\"map\" viewBox=\"0 0 {0:.0f} {1:.2f}\" "
      "data-metres-per-px=\"{2}\" data-west-m=\"{3}\" data-north-m=\"{4}\" role=\"img\" "
      "aria-label=\"map of the plan\">\n<rect class=\"paper\" width=\"100%\" "
      "height=\"100%\"/>\n<g id=\"grid\">{5}</g>\n<g id=\"layer\">{6}</g>\n"
      "<rect class=\"rim\" x=\".5\" y=\".5\" width=\"{7:.2f}\" height=\"{8:.2f}\"/>\n"
      "</svg>\n<div class=\"under\"><svg class=\"bar\" viewBox=\"0 -8 {0:.0f} "
      "20\">{9}</svg><svg "
      "width=\"170\" height=\"44\">{10}</svg><button data-zoom=\"1.5\" aria-label=\"zoom "
      "in\">+</button><button data-zoom=\"0.667\" aria-label=\"zoom "
      "out\">−</button><button data-zoom=\"0\">whole</button><span "
      "id=\"place\"></span></div>\n<svg viewBox=\"0 0 {0:.0f} {11:.0f}\" "
      "width=\"100%\">{12}</svg>\n</section>\n",
      view.width, view.height, view.metres_per_px, view.north_west.y(),
      view.north_west.x(), grid_layer(view), map_layer(document, view), view.width - 1,
      view.height - 1, scale_bar(view), wind_arrow(document), height, signs);
}

std::string course_of(const model::FlightMoment& m) {
  return shown_bearing(geo::bearing(m.v_N.head<2>()));
}

std::string row_of(const FlightElement& e, std::size_t plan, std::size_t k) {
  const model::FlightMoment begin = model::moment(e, 0), end = model::end_of(e);
  const std::string radius =
      e.turn_rate == 0 ? "" : fmt::format("{:.1f}", e.airspeed / std::abs(e.turn_rate));
  return fmt::format(
      "<tr data-element=\"e{}-{}\"><td>{}</td><td class=\"text\">{}</td><td>{:.2f}</td>"
      "<td>{:.2f}</td><td>{:.1f}</td><td>{}</td><td>{} → {}</td><td>{} → {}</td>"
      "<td>{:.1f} → {:.1f}</td><td>{} → {}</td></tr>\n",
      plan, k, k + 1, kind_of(e), e.start, e.duration, model::ground_length(e), radius,
      shown_bearing(begin.heading), shown_bearing(end.heading), course_of(begin),
      course_of(end), begin.v_N.head<2>().norm(), end.v_N.head<2>().norm(),
      shown_tenths(-begin.p_N.z()), shown_tenths(-end.p_N.z()));
}

std::string table_of(const NamedPlan& plan, std::size_t index) {
  std::string text = fmt::format(
      "<section>\n<h2><span class=\"swatch\" style=\"background:{}\"></span>{}{}: {}, {} "
      "over ground</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>#</th><th "
      "class=\"text\">element</th><th>start s</th><th>time s</th><th>over ground "
      "m</th><th>radius m</th><th>heading °</th><th>course °</th><th>ground speed "
      "m/s</th><th>altitude m</th></tr></thead>\n<tbody>\n",
      colour_of(index), escaped(plan.name),
      plan.word.empty() ? "" : " (" + escaped(plan.word) + ")",
      shown_time(model::duration(plan.plan)),
      shown_length(model::ground_length(plan.plan)));
  for (std::size_t k = 0; k < plan.plan.size() && k < kMaxRows; ++k)
    text += row_of(plan.plan[k], index, k);
  text += "</tbody></table></div>\n";
  if (plan.plan.size() > kMaxRows)
    text += fmt::format("<p>The first {} of {} elements; GeoJSON has all.</p>\n",
                        kMaxRows, plan.plan.size());
  return text + "</section>\n";
}

std::string facts_part(const Document& document) {
  if (document.facts.empty()) return {};
  std::string text = "<dl class=\"facts\">\n";
  for (const auto& [name, value] : document.facts)
    text +=
        fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
  return text + "</dl>\n";
}

}  // namespace

std::string to_html(const Document& document) {
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      // Nothing may be fetched: the page is the same with and without a network.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n<title>{0}</title>\n"
      "<style>{1}{2}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n",
      escaped(document.title), picture_style(), page_style());
  text += facts_part(document);
  text += map_part(document);
  for (std::size_t i = 0; i < document.plans.size(); ++i)
    text += table_of(document.plans[i], i);
  text += "</main>\n<script>";
  text += page_script();
  return text + "</script>\n</body>\n</html>\n";
}

}  // namespace skein::exchange
