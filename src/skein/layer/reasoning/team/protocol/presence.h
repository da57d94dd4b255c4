// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// How a member that does not lead says that it is there: in full (`inform`) when
/// something has changed that others act upon, some times over as messages are lost, and
/// now and then; in short (`here`) in between; not at all in a large team while all of it
/// was said not long ago.
class TeamPresence {
 public:
  /// One period is over.
  void send(MemberState& member);
  /// What it says next is said in full.
  void say_in_full();
  /// Two teams have met: both leaders have to know of all members.
  void note_encounter(double now) { regrouped_ = now; }

 private:
  bool has_said_all(const MemberState& member, const TeamInform& inform) const;

  TeamInform informed_;         // the last that it sent
  TeamHere here_;               // as it stood in that, or in the last `here`
  double said_here_ = -1e300;   // when [s]
  double regrouped_ = -1e300;   // when its team changed, or met another one [s]
  int in_full_ = 0;             // that are left to be sent in full
  int periods_since_full_ = 0;  // since the last that was
};

}  // namespace skein::reasoning
