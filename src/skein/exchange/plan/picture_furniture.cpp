// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "skein/exchange/plan/plan_picture.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

// Whole metres, or kilometres where lines are that far apart.
std::string shown_coordinate(double metres, double step) {
  return step >= 1000 ? fmt::format("{:g} km", metres / 1000)
                      : fmt::format("{:g}", metres);
}

// A row of signs and words that breaks at its width.
class LegendRows {
 public:
  explicit LegendRows(double width) : width_(width) {}

  void add(const std::string& sign, const std::string& words) {
    constexpr double kSign = 34, kLetter = 6.6, kGap = 18;
    const double wide = kSign + kLetter * static_cast<double>(words.size()) + kGap;
    if (x_ > 0 && x_ + wide > width_) {
      x_ = 0;
      y_ += kRow;
    }
    text_ += fmt::format(
        "<g transform=\"translate({:.0f} {:.0f})\">{}<text class=\"legend\" x=\"{}\" "
        "y=\"4\">{}</text></g>\n",
        x_, y_ + kRow / 2, sign, kSign, escaped(words));
    x_ += wide;
  }
  std::pair<std::string, double> finish() {
    return {std::move(text_), x_ > 0 || y_ > 0 ? y_ + kRow : 0};
  }

 private:
  static constexpr double kRow = 22;
  double width_, x_ = 0, y_ = 0;
  std::string text_;
};

}  // namespace

std::string grid_layer(const MapView& view) {
  const double step = round_below(view.width * view.metres_per_px / 5);
  std::string text;
  const Vec2 south_east =
      view.north_west + Vec2(-view.height, view.width) * view.metres_per_px;
  for (double e = std::ceil(view.north_west.y() / step) * step; e < south_east.y();
       e += step) {
    const double x = view.px({0, e}).x();
    text +=
        fmt::format("<path class=\"grid\" d=\"M{0:.2f} 0V{1:.2f}\"/>", x, view.height);
    if (x > 60 && x < view.width - 60)
      text += fmt::format(
          "<text class=\"coordinate\" x=\"{:.2f}\" y=\"{:.2f}\" "
          "text-anchor=\"middle\">{}</text>\n",
          x, view.height - 6, shown_coordinate(std::abs(e) < step / 2 ? 0.0 : e, step));
  }
  for (double n = std::ceil(south_east.x() / step) * step; n < view.north_west.x();
       n += step) {
    const double y = view.px({n, 0}).y();
    text += fmt::format("<path class=\"grid\" d=\"M0 {0:.2f}H{1:.2f}\"/>", y, view.width);
    if (y > 20 && y < view.height - 24)
      text +=
          fmt::format("<text class=\"coordinate\" x=\"6\" y=\"{:.2f}\">{}</text>\n",
                      y - 4, shown_coordinate(std::abs(n) < step / 2 ? 0.0 : n, step));
  }
  return text;
}

std::string scale_bar(const MapView& view) {
  const double metres = round_below(180 * view.metres_per_px);
  const double px = metres / view.metres_per_px;
  return fmt::format(
      "<g class=\"scale\"><rect width=\"{0:.2f}\" height=\"6\"/><rect class=\"light\" "
      "x=\"{1:.2f}\" y=\"1\" width=\"{2:.2f}\" height=\"4\"/><text x=\"{3:.2f}\" "
      "y=\"8\">{4}</text></g>\n",
      px, px / 2, px / 2 - 1, px + 8, shown_length(metres));
}

std::string wind_arrow(const Document& document) {
  const FlightElement* first = nullptr;
  for (const NamedPlan& plan : document.plans)
    if (!first && !plan.plan.empty()) first = &plan.plan.front();
  if (first == nullptr) return {};
  const double speed = first->wind.norm();
  if (speed == 0)
    return "<g class=\"wind\"><circle cx=\"22\" cy=\"22\" r=\"5\"/><text x=\"46\" "
           "y=\"26\">no wind</text></g>\n";
  const double to = geo::degrees(geo::bearing(first->wind));
  double from = std::fmod(to + 180, 360);
  if (from < 0) from += 360;
  return fmt::format(
      "<g class=\"wind\"><path transform=\"translate(22 22) rotate({:.1f})\" d=\"M0 18L0 "
      "-17M-6 -9L0 -18L6 -9\"/><text x=\"46\" y=\"18\">wind {:.3g} m/s</text><text "
      "x=\"46\" y=\"34\">from {:.0f}°</text></g>\n",
      to, speed, from);
}

std::pair<std::string, double> legend(const Document& document, double width) {
  LegendRows rows(width);
  constexpr std::size_t kMaxPlans = 12;
  for (std::size_t i = 0; i < document.plans.size() && i < kMaxPlans; ++i)
    rows.add(fmt::format("<path class=\"element\" stroke=\"{}\" d=\"M0 0H26\"/>",
                         colour_of(i)),
             document.plans[i].name);
  bool starts = false, goals = false;
  for (const Mark& mark : document.marks) {
    starts = starts || mark.kind == Mark::Kind::kStart;
    goals = goals || mark.kind == Mark::Kind::kGoal;
  }
  if (starts)
    rows.add("<g class=\"start\" transform=\"translate(13 0)\"><circle r=\"6\"/></g>",
             "start, with heading");
  if (goals)
    rows.add(
        "<g class=\"goal\" transform=\"translate(13 0)\"><circle r=\"6\"/><circle "
        "class=\"core\" r=\"2.5\"/></g>",
        "goal");
  if (!document.zones.empty())
    rows.add("<rect class=\"zone\" y=\"-8\" width=\"26\" height=\"16\"/>", "no-fly zone");
  if (!document.movers.empty())
    rows.add(
        "<circle class=\"mover\" cx=\"9\" r=\"7\"/><path class=\"mover-way\" d=\"M9 "
        "0H28\"/>",
        "moving obstacle, 30 s of its track");
  for (const Shape& shape : document.shapes)
    if (!shape.left_out)
      rows.add(shape.closed ? "<rect class=\"area\" y=\"-8\" width=\"26\" height=\"16\"/>"
                            : "<path class=\"line\" d=\"M0 0H26\"/>",
               shape.name);
  return rows.finish();
}

std::string picture_style() {
  return R"css(
text{font:12px system-ui,"Segoe UI",Roboto,Helvetica,Arial,sans-serif;fill:#2b3036}
.paper{fill:#fbfbf7}.sheet{fill:#fff}.rim{fill:none;stroke:#c9ccc4}
.grid{stroke:#e3e5dd;fill:none;vector-effect:non-scaling-stroke}
text.coordinate{font-size:10.5px;fill:#8b9089}
.zone{fill:#d6452f;fill-opacity:.17;stroke:#b5341f;stroke-width:1.2;vector-effect:non-scaling-stroke}
.limited{stroke-dasharray:6 4}
text.zone-name{fill:#8f2515;font-size:11.5px}text.zone-limits{fill:#a8473a;font-size:10px}
.area{fill:#3f8f52;fill-opacity:.10;stroke:#3f8f52;stroke-width:1.3;stroke-dasharray:7 4;vector-effect:non-scaling-stroke}
.hole{fill:#fbfbf7;fill-opacity:1}
.line{fill:none;stroke:#6b7178;stroke-width:3;stroke-opacity:.55;stroke-linecap:round;vector-effect:non-scaling-stroke}
.mover{fill:#e0a100;fill-opacity:.28;stroke:#9a6f00;vector-effect:non-scaling-stroke}
.mover-way{fill:none;stroke:#9a6f00;stroke-width:1.5;stroke-dasharray:3 3;vector-effect:non-scaling-stroke}
.element{fill:none;stroke-width:2.6;stroke-linecap:round;stroke-linejoin:round;vector-effect:non-scaling-stroke}
.joint{fill:#fff;stroke-width:1.4}.arrow{stroke:#fff;stroke-width:.8}
.clock-dot{fill:#23282d}
text.clock,text.zone-name,text.zone-limits,text.mark-name{paint-order:stroke;stroke:#fbfbf7;stroke-width:3px;stroke-linejoin:round}
text.clock{font-size:11px;fill:#3a4047}
text.mark-name{font-weight:600}
.start circle{fill:#1f9d55;stroke:#fff;stroke-width:2}.start path{stroke:#1f9d55;stroke-width:2.4;fill:none;stroke-linecap:round}
.goal circle{fill:#fff;stroke:#23282d;stroke-width:2.4}.goal .core{fill:#23282d;stroke:none}.goal path{stroke:#23282d;stroke-width:2.4;fill:none;stroke-linecap:round}
.place circle{fill:#6b4ea0;stroke:#fff;stroke-width:2}.place path{stroke:#6b4ea0;stroke-width:2.4;fill:none}
.scale rect{fill:#2b3036}.scale .light{fill:#fff}
.wind path{fill:none;stroke:#2274a5;stroke-width:2.6;stroke-linecap:round;stroke-linejoin:round}.wind circle{fill:none;stroke:#2274a5;stroke-width:2}
text.title{font-size:18px;font-weight:600}text.fact{fill:#565c63}text.fact-value{font-weight:600}
)css";
}

}  // namespace skein::exchange
