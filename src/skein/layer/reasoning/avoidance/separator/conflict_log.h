// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "skein/data/team/separation_message.h"
#include "skein/layer/reasoning/avoidance/flights/conflicts.h"

namespace skein::reasoning {

/// Keeps account of the conflicts of one aircraft, for the records.
class ConflictLog {
 public:
  /// The conflicts that there are now. One is over when it was solved, its time has
  /// passed and the two have been apart for five seconds.
  void see(Time now, std::span<const Conflict> conflicts);

  /// A method has changed the own flight because of another aircraft.
  void solved(EntityId other, Time now, SeparationMethod method, std::string_view what);
  /// A message about it was sent.
  void sent(EntityId other, std::size_t bytes);
  /// By what both report, the two are so near now.
  void flown(EntityId other, double ratio);

  /// Those that are over since the last call.
  std::vector<ConflictReport> take();

 private:
  struct Open {
    ConflictReport report;
    Time last_seen, closest;
  };
  std::map<EntityId, Open> open_;
  std::vector<ConflictReport> over_;
};

}  // namespace skein::reasoning
