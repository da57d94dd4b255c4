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

void Problems::note(Rename rename) {
  // As many as a large file may have, bounded as all that it can make grow.
  constexpr std::size_t kMaxRenames = 100'000;
  if (rename.place.source == 0 && renames_.size() < kMaxRenames)
    renames_.push_back(std::move(rename));
}

std::vector<Rename> Problems::take_renames() {
  std::stable_sort(renames_.begin(), renames_.end(),
                   [](const Rename& a, const Rename& b) { return a.place < b.place; });
  return std::exchange(renames_, {});
}

std::vector<Problem> Problems::take() {
  std::stable_sort(list_.begin(), list_.end(),
                   [](const Problem& a, const Problem& b) { return a.place < b.place; });
  count_ = 0;
  return std::exchange(list_, {});
}

}  // namespace skein::scenario
