// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/mission_figure_text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace skein::record {
namespace {

struct FigureText {
  std::string_view figure, text;
};

constexpr std::array kTexts =
    std::to_array<FigureText>({{"begun_s", "began at [s]"},
                               {"took_s", "took [s]"},
                               {"seen", "share of the area seen"},
                               {"seen_95_s", "95 % of it seen after [s]"},
                               {"seen_all_s", "all of it seen after [s]"},
                               {"planned_s", "planned duration [s]"},
                               {"seen_all_of_plan", "all seen after, times the plan"},
                               {"found", "objects found"},
                               {"in_view", "share of time in view, mean"},
                               {"in_view_worst", "share of time in view, least"},
                               {"error_rms_m", "error of believed places, RMS [m]"},
                               {"error_max_m", "error of believed places, largest [m]"},
                               {"visited", "share of the line visited"},
                               {"age_max_s", "oldest visit ago [s]"},
                               {"revisit_mean_s", "time between visits, mean [s]"},
                               {"revisit_max_s", "time between visits, longest [s]"},
                               {"slot_error_mean_m", "distance from places, mean [m]"},
                               {"slot_error_95_m", "distance from places, 95 % [m]"},
                               {"slot_error_max_m", "distance from places, most [m]"},
                               {"in_place", "share of time at their places"},
                               {"apart_min_m", "least distance between two [m]"}});

constexpr std::array kForecastTexts =
    std::to_array<FigureText>({{"iou_mean", "intersection over union, mean"},
                               {"coverage_95_mean", "share in its 95 % band, mean"},
                               {"crps_mean_m", "CRPS, mean [m]"}});

// "forecast_600s_iou_mean".
std::optional<std::string> forecast_text(std::string_view name) {
  constexpr std::string_view kPrefix = "forecast_";
  if (!name.starts_with(kPrefix)) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  double horizon = 0;
  const auto [end, failure] =
      std::from_chars(name.data(), name.data() + name.size(), horizon);
  name.remove_prefix(static_cast<std::size_t>(end - name.data()));
  if (failure != std::errc() || !name.starts_with("s_")) return std::nullopt;
  name.remove_prefix(2);
  for (const FigureText& each : kForecastTexts)
    if (each.figure == name)
      return fmt::format("forecast {:g} min ahead: {}", horizon / 60, each.text);
  return std::nullopt;
}

}  // namespace

std::string_view mission_figure_text(std::string_view figure) {
  for (const FigureText& each : kTexts)
    if (each.figure == figure) return each.text;
  return {};
}

std::optional<std::string> mission_number_text(std::string_view name) {
  constexpr std::string_view kPrefix = "mission_";
  if (!name.starts_with(kPrefix)) return forecast_text(name);
  name.remove_prefix(kPrefix.size());
  // The longest that fits: "slot_error_max_m" ends like "error_max_m".
  const FigureText* found = nullptr;
  for (const FigureText& each : kTexts) {
    if (!name.ends_with(each.figure) || name.size() < each.figure.size() + 2 ||
        name[name.size() - each.figure.size() - 1] != '_')
      continue;
    if (!found || each.figure.size() > found->figure.size()) found = &each;
  }
  if (!found) return std::nullopt;
  return std::string(name.substr(0, name.size() - found->figure.size() - 1)) + ": " +
         std::string(found->text);
}

}  // namespace skein::record
