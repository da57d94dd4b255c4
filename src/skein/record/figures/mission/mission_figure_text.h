// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::record {

/// What a figure of a mission says, for people: "share of the area seen" for "seen".
/// Empty for one that is not known.
std::string_view mission_figure_text(std::string_view figure);

/// The same of a number of the summary: "village: share of the area seen" for
/// "mission_village_seen", "forecast 10 min ahead: intersection over union, mean" for
/// "forecast_600s_iou_mean"; none when it is neither a figure of a mission nor one of the
/// main figures of its forecasts.
std::optional<std::string> mission_number_text(std::string_view name);

}  // namespace skein::record
