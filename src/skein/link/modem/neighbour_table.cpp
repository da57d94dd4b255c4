// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/neighbour_table.h"

#include <algorithm>

namespace skein::modem {

NeighbourTable::NeighbourTable(std::size_t entities, Time patience)
    : patience_(patience), entries_(entities) {}

bool NeighbourTable::takes(Address who) const {
  return who.sw < entries_.size() && who.hw != kAll &&
         entries_[who.sw].hw.value_or(who.hw) == who.hw;
}

void NeighbourTable::advertised(Address who, Time now,
                                std::vector<NeighbourChange>& changes) {
  if (!takes(who)) return;
  Entry& entry = entries_[who.sw];
  entry.heard = now;
  if (entry.hw) return;
  entry.hw = who.hw;
  ++count_;
  changes.push_back({EntityId{who.sw}, who.hw, true});
}

bool NeighbourTable::heard(Address who, Time now) {
  if (who.sw >= entries_.size() || entries_[who.sw].hw != who.hw) return false;
  entries_[who.sw].heard = now;
  return true;
}

void NeighbourTable::step(Time now, std::vector<NeighbourChange>& changes) {
  for (std::uint32_t sw = 0; sw < entries_.size(); ++sw) {
    Entry& entry = entries_[sw];
    if (!entry.hw || now - entry.heard <= patience_) continue;
    changes.push_back({EntityId{sw}, *entry.hw, false});
    entry.hw.reset();
    --count_;
  }
}

std::optional<Address> NeighbourTable::find(EntityId who) const {
  if (who.value >= entries_.size() || !entries_[who.value].hw) return std::nullopt;
  return Address{*entries_[who.value].hw, who.value};
}

bool NeighbourTable::reaches_through(std::uint32_t hw) const {
  return std::ranges::any_of(entries_, [hw](const Entry& each) { return each.hw == hw; });
}

}  // namespace skein::modem
