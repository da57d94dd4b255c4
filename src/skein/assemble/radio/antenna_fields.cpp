// SPDX-License-Identifier: Apache-2.0
// The keys of antennas.
#include "skein/assemble/radio/antenna_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace skein::assemble {
namespace {

using communication::AntennaProfile;
using scenario::Range;
using scenario::RuleViolation;

constexpr Range kAzimuth{.at_least = 0, .below = 360};
constexpr Range kElevation{.at_least = -90, .at_most = 90};
constexpr std::size_t kMaxAxis = 720;

bool is_growing(const std::vector<double>& axis) {
  return std::adjacent_find(axis.begin(), axis.end(), std::greater_equal<>()) ==
         axis.end();
}

std::vector<RuleViolation> antenna_errors(const AntennaChoice& choice) {
  const AntennaProfile& antenna = choice.section;
  std::vector<RuleViolation> found;
  if (antenna.shadow_edge > 2 * antenna.shadow_half_width)
    found.push_back({"shadow_edge_deg", "must be at most twice shadow_half_width_deg."});
  for (const auto& [key, axis] : {std::pair("azimuths_deg", &antenna.azimuths),
                                  std::pair("elevations_deg", &antenna.elevations)}) {
    if (!is_growing(*axis))
      found.push_back({key, "must grow from one to the next."});
    else if (choice.model.kind == "table" && axis->empty())
      found.push_back({key, "must not be empty: the model is a table."});
  }
  if (antenna.gains_db.size() != antenna.elevations.size())
    found.push_back(
        {"gains_db", fmt::format("has {} rows; needs one for each of {} "
                                 "elevations.",
                                 antenna.gains_db.size(), antenna.elevations.size())});
  for (std::size_t k = 0; k < antenna.gains_db.size(); ++k)
    if (antenna.gains_db[k].size() != antenna.azimuths.size()) {
      found.push_back(
          {"gains_db",
           fmt::format("row {} has {} gains; needs one for each of {} "
                       "azimuths. Rows are counted from 0.",
                       k, antenna.gains_db[k].size(), antenna.azimuths.size())});
      break;
    }
  return found;
}

}  // namespace

scenario::Fields<AntennaChoice> antenna_fields() {
  using T = AntennaChoice;
  const auto in = [](auto member) {
    return [member](T & t) -> auto& {
      return t.section.*member;
    };
  };
  return scenario::Fields<T>()
      .kind("model", &T::model, "antenna",
            "In which directions it sends and receives, beside the nominal gains.")
      .number("min_gain_db", in(&AntennaProfile::min_gain_db),
              "Of `dipole`: along its rod.", {.at_least = -100, .at_most = 0})
      .angle_deg("shadow_azimuth_deg", in(&AntennaProfile::shadow_azimuth),
                 "Of `shadowed-by-body`: where the body is as the antenna sees it, from "
                 "forward to the right.")
      .angle_deg("shadow_elevation_deg", in(&AntennaProfile::shadow_elevation),
                 "The same, from the body's horizon up.", kElevation)
      .angle_deg("shadow_half_width_deg", in(&AntennaProfile::shadow_half_width),
                 "From the middle of the body to where half of the decibels are lost.",
                 {.at_least = 0.5, .at_most = 180})
      .angle_deg("shadow_edge_deg", in(&AntennaProfile::shadow_edge),
                 "Over which the loss goes from none to all.",
                 {.at_least = 0.1, .at_most = 180})
      .number("shadow_depth_db", in(&AntennaProfile::shadow_depth_db),
              "That are lost behind the body.", {.at_least = 0, .at_most = 100})
      .angle_deg("azimuths_deg", in(&AntennaProfile::azimuths),
                 "Of `table`: of its columns, growing; they go round.", kAzimuth)
      .items({.at_most = kMaxAxis})
      .angle_deg("elevations_deg", in(&AntennaProfile::elevations),
                 "Of `table`: of its rows, growing. Beyond them the nearest holds.",
                 kElevation)
      .items({.at_most = kMaxAxis})
      .number("gains_db", in(&AntennaProfile::gains_db),
              "Of `table`: rows, a gain for each azimuth in each.",
              {.at_least = -100, .at_most = 100})
      .items({.at_most = kMaxAxis})
      .rules(antenna_errors);
}

}  // namespace skein::assemble
