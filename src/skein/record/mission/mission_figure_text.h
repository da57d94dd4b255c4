#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skein::record {

/// What a figure of a mission says, for people: "share of the area seen" for "seen".
/// Empty for one that is not known.
std::string_view mission_figure_text(std::string_view figure);

/// The same of a number of the summary: "village: share of the area seen" for
/// "mission_village_seen"; none when it is no figure of a mission.
std::optional<std::string> mission_number_text(std::string_view name);

}  // namespace skein::record
