// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "skein/data/airspace/zone_change.h"

namespace skein {

/// The no-fly zones in force, as one entity knows them: those it has known from the
/// start, and the changes it has received.
///
/// Changes may come late, twice and in any order: of one name the change with the highest
/// number counts, so that all who have received the same changes know the same zones.
class ZoneSet {
 public:
  explicit ZoneSet(std::span<const Zone> known = {})
      : zones_(known.begin(), known.end()) {}

  /// Takes in a numbered change. One without number, or with a zone that error_in()
  /// rejects, is passed over.
  /// @returns  whether zones() has changed.
  bool take(const ZoneChange& change);

  /// In force: known ones first, then in the order in which they were received.
  std::span<const Zone> zones() const { return zones_; }

  /// Whether a zone of this name has been received, rather than known from the start.
  bool heard(const std::string& name) const { return newest_.count(name) > 0; }

  /// All changes up to this number have been received; 0 = none.
  std::uint32_t complete_to() const { return complete_to_; }

 private:
  std::vector<Zone> zones_;
  std::map<std::string, std::uint32_t> newest_;  // change of each name
  std::uint32_t complete_to_ = 0;
  std::set<std::uint32_t> beyond_;  // received with gaps before them
};

}  // namespace skein
