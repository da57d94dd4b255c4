// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/plan_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/text_shown.h"

namespace skein::exchange {
namespace {

constexpr double kLineTolerance = 0.15;  // [px]
constexpr std::size_t kMaxJoints = 40;   // that are marked; more are a string of beads
constexpr int kClocks = 8;               // times along a plan, about

class Painter {
 public:
  Painter(const Document& document, const MapView& view)
      : document_(document), view_(view) {}

  std::string paint() {
    for (const Shape& shape : document_.shapes) paint_shape(shape);
    for (const Zone& zone : document_.zones) paint_zone(zone);
    for (const MovingObstacle& m : document_.movers) paint_mover(m);
    for (std::size_t i = 0; i < document_.plans.size(); ++i) paint_plan(i);
    for (std::size_t i = 0; i < document_.plans.size(); ++i) paint_clocks(i);
    for (const Mark& mark : document_.marks) paint_mark(mark);
    return std::move(text_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  template <class Points>
  std::string path_data(const Points& points) const {
    std::string d;
    for (const Vec2& p : points) {
      const Vec2 at = view_.px(p);
      fmt::format_to(std::back_inserter(d), "{}{:.2f} {:.2f}", d.empty() ? "M" : "L",
                     at.x(), at.y());
    }
    return d;
  }

  void label(const Vec2& at, const std::string& text, const char* kind, double dx,
             double dy, const char* anchor) {
    if (text.empty()) return;
    put("<g class=\"fixed\" transform=\"translate({:.2f} {:.2f})\"><text class=\"{}\" "
        "x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text></g>\n",
        at.x(), at.y(), kind, dx, dy, anchor, escaped(text));
  }

  void paint_shape(const Shape& shape) {
    if (shape.points.empty()) return;
    put("<path class=\"{}\" d=\"{}{}\"><title>{}</title></path>\n",
        shape.left_out ? "area hole"
        : shape.closed ? "area"
                       : "line",
        path_data(shape.points), shape.closed ? "Z" : "", escaped(shape.name));
  }

  static std::string limits(const Zone& zone) {
    std::string text;
    const bool floor = std::isfinite(zone.floor_msl),
               ceiling = std::isfinite(zone.ceiling_msl), from = std::isfinite(zone.from),
               until = std::isfinite(zone.until);
    if (floor || ceiling)
      text += fmt::format("{} to {}",
                          floor ? fmt::format("{:.0f}", zone.floor_msl) : "ground",
                          ceiling ? fmt::format("{:.0f} m", zone.ceiling_msl) : "any");
    if (from || until)
      text += fmt::format("{}{} to {}", text.empty() ? "" : ", ",
                          from ? shown_clock(zone.from) : "start",
                          until ? shown_clock(zone.until) : "end");
    return text;
  }

  void paint_zone(const Zone& zone) {
    const std::string about = limits(zone);
    const char* const kind = about.empty() ? "zone" : "zone limited";
    Vec2 middle = Vec2::Zero();
    if (const auto* disc = std::get_if<Disc>(&zone.area)) {
      middle = view_.px(disc->centre);
      put("<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", kind,
          middle.x(), middle.y(), disc->radius / view_.metres_per_px);
    } else {
      const geo::Ring& ring = std::get<geo::Ring>(zone.area);
      put("<path class=\"{}\" d=\"{}Z\"/>\n", kind, path_data(ring));
      for (const Vec2& p : ring) middle += view_.px(p) / static_cast<double>(ring.size());
    }
    label(middle, zone.name, "zone-name", 0, about.empty() ? 4 : -2, "middle");
    label(middle, about, "zone-limits", 0, zone.name.empty() ? 4 : 11, "middle");
  }

  void paint_mover(const MovingObstacle& m) {
    const Vec2 at = view_.px(m.p_N.head<2>());
    const Vec2 later = view_.px(m.p_N.head<2>() + 30 * m.v_N.head<2>());
    put("<circle class=\"mover\" cx=\"{:.2f}\" cy=\"{:.2f}\" "
        "r=\"{:.2f}\"><title>obstacle "
        "at {}</title></circle>\n<path class=\"mover-way\" d=\"M{:.2f} {:.2f}L{:.2f} "
        "{:.2f}\"/>\n",
        at.x(), at.y(), m.radius / view_.metres_per_px, shown_clock(m.time), at.x(),
        at.y(), later.x(), later.y());
  }

  void paint_plan(std::size_t index) {
    const FlightPlan& plan = document_.plans[index].plan;
    put("<g class=\"plan\" stroke=\"{0}\" fill=\"{0}\">\n", colour_of(index));
    for (std::size_t k = 0; k < plan.size(); ++k) {
      std::vector<Vec2> points;
      for (const FlightSample& each :
           samples(plan[k], kLineTolerance * view_.metres_per_px))
        points.emplace_back(each.moment.p_N.head<2>());
      put("<path class=\"element\" id=\"e{}-{}\" d=\"{}\"><title>{} {}, {} to "
          "{}</title></path>\n",
          index, k, path_data(points), escaped(document_.plans[index].name),
          kind_of(plan[k]), shown_clock(plan[k].start),
          shown_clock(plan[k].start + plan[k].duration));
    }
    for (std::size_t k = 1; k < plan.size() && plan.size() <= kMaxJoints; ++k) {
      const Vec2 at = view_.px(plan[k].p_N.head<2>());
      put("<g class=\"fixed\" transform=\"translate({:.2f} {:.2f})\"><circle "
          "class=\"joint\" r=\"2.4\"/></g>\n",
          at.x(), at.y());
    }
    paint_arrows(plan);
    put("</g>\n");
  }

  // Where it goes, near the middle of the elements that are long enough on the picture.
  void paint_arrows(const FlightPlan& plan) {
    constexpr double kLongEnough = 60;  // [px]
    double since = kLongEnough;
    for (const FlightElement& e : plan) {
      const double length = model::ground_length(e) / view_.metres_per_px;
      since += length;
      if (length < kLongEnough / 2 || since < kLongEnough) continue;
      since = 0;
      const model::FlightMoment middle = model::moment(e, 0.42 * e.duration);
      const Vec2 at = view_.px(middle.p_N.head<2>());
      const double course = geo::degrees(geo::bearing(middle.v_N.head<2>()));
      // The rotation is inside, so that the outer transform is a translation only.
      put("<g class=\"fixed\" transform=\"translate({:.2f} {:.2f})\"><path "
          "class=\"arrow\" "
          "transform=\"rotate({:.1f})\" d=\"M0 -8L6 7L0 3.5L-6 7Z\"/></g>\n",
          at.x(), at.y(), course);
    }
  }

  // Times at round moments along the flight.
  void paint_clocks(std::size_t index) {
    const FlightPlan& plan = document_.plans[index].plan;
    if (plan.empty() || document_.plans.size() > 4) return;
    const double start = model::start_of(plan), end = model::end_time_of(plan);
    const double step = clock_step((end - start) / kClocks);
    for (double t = (std::floor(start / step) + 1) * step; t < end - step / 3;
         t += step) {
      const model::FlightMoment m = model::moment_at(plan, t);
      const Vec2 at = view_.px(m.p_N.head<2>());
      // To the right of the path.
      const Vec2 side = geo::turned_right(geo::unit(geo::bearing(m.v_N.head<2>())));
      put("<g class=\"fixed\" transform=\"translate({:.2f} {:.2f})\"><circle "
          "class=\"clock-dot\" r=\"2\"/></g>\n",
          at.x(), at.y());
      const double dx = 9 * side.y(), dy = 4 - 11 * side.x();
      label(at, shown_clock(t), "clock", std::round(dx), std::round(dy),
            side.y() > 0.4    ? "start"
            : side.y() < -0.4 ? "end"
                              : "middle");
    }
  }

  // At least `min`, and round as clocks are.
  static double clock_step(double min) {
    for (const double step :
         {1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0})
      if (step >= min) return step;
    return 3600 * std::ceil(min / 3600);
  }

  void paint_mark(const Mark& mark) {
    const Vec2 at = view_.px(mark.p_N.head<2>());
    constexpr const char* kClass[] = {"start", "goal", "place"};
    put("<g class=\"fixed\" transform=\"translate({:.2f} {:.2f})\"><g class=\"{}\">",
        at.x(), at.y(), kClass[static_cast<int>(mark.kind)]);
    if (mark.heading)
      put("<path transform=\"rotate({:.1f})\" d=\"M0 -8L0 -19M-4 -15L0 -20L4 -15\"/>",
          geo::degrees(*mark.heading));
    put("<circle r=\"7\"/>");
    if (mark.kind == Mark::Kind::kGoal) put("<circle class=\"core\" r=\"3\"/>");
    put("</g></g>\n");
    label(at, mark.name, "mark-name", 12, mark.kind == Mark::Kind::kGoal ? -10 : 20,
          "start");
  }

  const Document& document_;
  const MapView& view_;
  std::string text_;
};

}  // namespace

const char* colour_of(std::size_t index) {
  constexpr const char* kColours[] = {"#0b5fa5", "#c4510f", "#2c7d43", "#7a4aa8",
                                      "#b02a5b", "#0f8587", "#8a6a00", "#5b6770"};
  return kColours[index % std::size(kColours)];
}

std::string map_layer(const Document& document, const MapView& view) {
  return Painter(document, view).paint();
}

}  // namespace skein::exchange
