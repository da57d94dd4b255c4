#pragma once

#include <optional>

#include "skein/layer/reasoning/planning/search/chain.h"
#include "skein/layer/reasoning/planning/search/ways.h"

namespace skein::planning {

/// How finely states beside a way are tried.
enum class Detail { kCoarse, kFine };

/// A chain of states along a way around rounds that a real aircraft can fly: beside each
/// arc some states are offered, further out or turned, and of all chains through one
/// state per place the quickest that is free is taken, place by place in the order of
/// earliest arrival. Places may be passed by.
/// @returns  a free chain, or nothing.
/// Cost: of n states per place 2 n^2 links per place.
std::optional<Chain> follow_way(const Way& way, const AirspaceMap& map, Effort& effort,
                                Detail detail);

}  // namespace skein::planning
