// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <utility>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// Sees to it that of two members that execute one task for one aircraft, one stops.
///
/// Where the leader of both receives only one of them, it has given that one the task of
/// the other, whom it has lost: the other stops. Of two leaders that do not receive each
/// other the lower one's member flies on; who leads says nothing of its own task, so it
/// is the one who drops it.
class DuplicateTasks {
 public:
  void on(MemberState& member, EntityId from, const TeamInform& inform);
  /// What it leaves to another team it refuses, as long as it receives that this executes
  /// it.
  static void renew_refusals(MemberState& member);

 private:
  std::set<std::pair<std::uint32_t, EntityId>> known_;  // and who executes it too
};

}  // namespace skein::reasoning
