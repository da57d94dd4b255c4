// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::scenario {

std::string Problem::text() const {
  std::string text = source;
  if (place.line > 0) text += fmt::format(":{}:{}", place.line, place.column);
  if (!key.empty()) text += " " + key;
  text += ": " + message;
  if (!hint.empty()) text += " " + hint;
  return text;
}

void Problems::add(const Place& place, std::string key, std::string message,
                   std::string hint) {
  ++count_;
  if (full()) return;
  const auto source = static_cast<std::size_t>(place.source);
  list_.push_back(
      {place, sources_.at(source), std::move(key), std::move(message), std::move(hint)});
}

std::vector<Problem> Problems::take() {
  std::stable_sort(list_.begin(), list_.end(),
                   [](const Problem& a, const Problem& b) { return a.place < b.place; });
  count_ = 0;
  return std::exchange(list_, {});
}

}  // namespace skein::scenario
