// SPDX-License-Identifier: Apache-2.0
#include "skein/data/airspace/zone_command.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "skein/data/describe/words.h"

namespace skein {
namespace {

constexpr const char* kZoneUsage =
    "Say: zone off NAME, or zone on NAME [circle NORTH,EAST RADIUS | ring NORTH,EAST "
    "NORTH,EAST ...] [floor M] [ceiling M] [from S] [until S].";

Error wrong(std::string message) {
  return {ErrorCode::kBadInput, "", std::move(message), kZoneUsage};
}

using words::number;
using words::place;

double* limit(Zone& zone, std::string_view word) {
  if (word == "floor") return &zone.floor_msl;
  if (word == "ceiling") return &zone.ceiling_msl;
  if (word == "from") return &zone.from;
  if (word == "until") return &zone.until;
  return nullptr;
}

// The shape that begins at word `next`, which moves behind it; an error's text if any.
std::string take_shape(const std::vector<std::string_view>& words, std::size_t& next,
                       Zone& zone) {
  const std::string_view kind = words[next++];
  if (kind == "circle") {
    const auto centre = next < words.size() ? place(words[next]) : std::nullopt;
    const auto radius = next + 1 < words.size() ? number(words[next + 1]) : std::nullopt;
    if (!centre || !radius) return "a circle needs NORTH,EAST and a radius in metres.";
    zone.area = Disc{*centre, *radius};
    next += 2;
    return {};
  }
  if (kind != "ring") return fmt::format("\"{}\" is no shape.", kind);
  geo::Ring ring;
  for (; next < words.size() && !limit(zone, words[next]); ++next) {
    const auto corner = place(words[next]);
    if (!corner) return fmt::format("\"{}\" is no place NORTH,EAST.", words[next]);
    ring.push_back(*corner);
  }
  zone.area = std::move(ring);
  return {};
}

}  // namespace

Result<ZoneChange> parse_zone_command(std::string_view line) {
  const std::vector<std::string_view> words = skein::words::split(line);
  if (words.size() < 3 || words[0] != "zone" || (words[1] != "on" && words[1] != "off"))
    return wrong("this is no command.");
  ZoneChange change;
  change.on = words[1] == "on";
  change.zone.name = std::string(words[2]);
  if (words.size() == 3) return change;
  if (!change.on) return wrong("a zone that is taken back needs its name only.");
  std::size_t next = 3;
  if (const std::string error = take_shape(words, next, change.zone); !error.empty())
    return wrong(error);
  while (next < words.size()) {
    double* value = limit(change.zone, words[next]);
    const auto given = next + 1 < words.size() ? number(words[next + 1]) : std::nullopt;
    if (!value || !given)
      return wrong(fmt::format("\"{}\" is no limit with its number.", words[next]));
    *value = *given;
    next += 2;
  }
  if (const auto error = error_in(change.zone))
    return wrong(fmt::format("the zone {} cannot be used: {}", change.zone.name, *error));
  if (auto* ring = std::get_if<geo::Ring>(&change.zone.area))
    *ring = made_positive(*ring);
  return change;
}

}  // namespace skein
