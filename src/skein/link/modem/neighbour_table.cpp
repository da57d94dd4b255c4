#include "skein/link/modem/neighbour_table.h"

namespace skein::modem {

NeighbourTable::NeighbourTable(std::size_t entities, Time patience)
    : patience_(patience), entries_(entities) {}

void NeighbourTable::advertised(Address who, Time now,
                                std::vector<NeighbourChange>& changes) {
  if (who.sw >= entries_.size() || who.hw == kAll) return;
  Entry& entry = entries_[who.sw];
  if (entry.hw && *entry.hw != who.hw) return;
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

}  // namespace skein::modem
