// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/reasoning/avoidance/negotiation/deal.h"

namespace skein::reasoning {

/// A bargain of a file, with its name there.
struct NamedBargain {
  std::string id;
  Bargain bargain;
};

/// Reads a list of bargains:
///
///   [{"id": "n000", "utility_1": [1.0, 0.69], "utility_2": [1.0], "free": [[0], [1]]}]
///
/// Utilities are numbers from 0 to 1, `free[k][l]` is 0 or 1. The keys `sum`, `product`,
/// `zeuthen` and `rounds`, which say what somebody expects, are passed over.
///
/// @param name  of the text, for messages.
/// Fails: kBadInput, with up to 20 problems and their places: other keys, a key or an id
///        twice, sizes that do not fit, numbers out of bounds, more than 1000 options or
///        100,000 bargains.
Result<std::vector<NamedBargain>> read_bargains(std::string_view text,
                                                const std::string& name);

/// The deals by all three rules, comma-separated with a header line: id, sum_k, sum_l,
/// product_k, product_l, zeuthen_k, zeuthen_l, rounds; in the order of the bargains. The
/// cells are empty where no pair is free.
std::string deals_csv(const std::vector<NamedBargain>& bargains);

}  // namespace skein::reasoning
