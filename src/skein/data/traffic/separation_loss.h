// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// What two aircraft do that come too near to each other.
enum class SeparationPhase : std::uint8_t {
  kAir,        ///< both fly, each by itself
  kFormation,  ///< both fly, as members of one formation
  kGround,     ///< at least one of them stands or rolls
};
constexpr auto names_of(const SeparationPhase*) {
  return std::to_array<std::string_view>({"air", "formation", "ground"});
}

/// Two aircraft that came nearer to each other than they have to keep, by the truth: one
/// encounter from when their separation is lost until they are well apart again.
struct SeparationLossRecord {
  Time time;  ///< when it was over, or the run was
  EntityId id, other;
  SeparationPhase phase = SeparationPhase::kAir;  ///< at `closest`
  Time begun;                                     ///< when separation was lost
  Time closest;                                   ///< when `ratio` was least
  double ratio = 0;                ///< least distance over what is required, below 1
  double horizontal = 0;           ///< at `closest` [m]
  double vertical = 0;             ///< at `closest` [m]
  double distance = 0;             ///< least during the encounter [m]
  double required_horizontal = 0;  ///< of the pair [m]
  double required_vertical = 0;    ///< of the pair [m]
  bool over = true;                ///< else the run, or the part of one of both, ended
};

constexpr auto describe(const SeparationLossRecord*) {
  using T = SeparationLossRecord;
  return described<T>(
      {"separation_loss", "separation_losses"},
      "Two aircraft that came nearer to each other than they have to keep, by the truth.",
      field("time", &T::time, "when they were well apart again, or the run ended"),
      field("entity_id", &T::id, "one of both, of the lower number"),
      field("other_id", &T::other, "the other"),
      field("phase", &T::phase, "what both did when they were closest"),
      field("begun", &T::begun, "when separation was lost"),
      field("closest", &T::closest, "when the ratio was least"),
      field("ratio", &T::ratio,
            "least distance over what is required: the larger of the horizontal and the "
            "vertical one"),
      field("horizontal", &T::horizontal, unit::kMetre, "distance when closest"),
      field("vertical", &T::vertical, unit::kMetre, "distance when closest"),
      field("distance", &T::distance, unit::kMetre, "least, straight"),
      field("required_horizontal", &T::required_horizontal, unit::kMetre,
            "of the pair, unless the vertical one is kept"),
      field("required_vertical", &T::required_vertical, unit::kMetre,
            "of the pair, unless the horizontal one is kept"),
      field("over", &T::over,
            "they were well apart again; else one has left, or the run "
            "has ended"));
}

}  // namespace skein
