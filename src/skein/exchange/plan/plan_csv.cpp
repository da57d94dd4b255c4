// SPDX-License-Identifier: Apache-2.0
#include <fmt/compile.h>
#include <fmt/format.h>

#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/writers.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

// A cell of text: in quotation marks where it must be, control characters as blanks.
std::string cell(const std::string& text) {
  std::string plain, quoted = "\"";
  bool special = false;
  for (const char c : text) {
    const char shown = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    special = special || shown == ',' || shown == '"';
    plain += shown;
    if (shown == '"') quoted += '"';
    quoted += shown;
  }
  return special ? quoted + '"' : plain;
}

}  // namespace

std::string to_csv(const Document& document, const WritingOptions& options) {
  std::string text =
      "plan,element,time_s,north_m,east_m,altitude_m,latitude_deg,longitude_deg,"
      "heading_deg,course_deg,airspeed_mps,ground_speed_mps,climb_mps\n";
  const auto out = std::back_inserter(text);
  for (const NamedPlan& plan : document.plans) {
    const std::string name = cell(plan.name);
    for (const FlightSample& each : samples(plan.plan, options.tolerance, options.step)) {
      const Vec3& p = each.moment.p_N;
      const Vec2 over_ground = each.moment.v_N.head<2>();
      fmt::format_to(out, FMT_COMPILE("{},{},{},{},{},{},"), name, each.element,
                     each.time, p.x(), p.y(), 0.0 - p.z());
      if (document.frame) {
        const geo::Geodetic at = document.frame->from_plane(p.head<2>());
        fmt::format_to(out, FMT_COMPILE("{},{},"), at.latitude_deg, at.longitude_deg);
      } else {
        text += ",,";
      }
      fmt::format_to(out, FMT_COMPILE("{},{},{},{},{}\n"),
                     geo::degrees(geo::wrap_2pi(each.moment.heading)),
                     geo::degrees(geo::wrap_2pi(geo::bearing(over_ground))),
                     plan.plan[each.element].airspeed, over_ground.norm(),
                     0.0 - each.moment.v_N.z());
    }
  }
  return text;
}

}  // namespace skein::exchange
