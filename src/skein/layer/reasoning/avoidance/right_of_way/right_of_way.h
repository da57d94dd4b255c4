// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "skein/data/radio/message.h"

namespace skein::reasoning {

/// A request that was sent, to whom, and what came of it.
struct SentRequest {
  EntityId whom;
  YieldRequest request;
  double repeat = 1;  // [s]
  Time said;
  int times = 0;
  bool answered = false, given_up = false;
};

/// Swaps the order of two aircraft for one conflict: the lower one, which finds no flight
/// around the higher one, asks it to give way; the higher one does so once, or refuses.
///
/// A request is repeated until it is answered, three times at most. The same request
/// has the same answer however often it comes. A granted one swaps the order of the two
/// from then on until 30 s after the conflict: of the higher one from its decision, of
/// the lower one from the answer, so neither ever counts on the other's giving way when
/// that does not.
/// Reference: spec/team.md sections 5 and 9.
class RightOfWay {
 public:
  explicit RightOfWay(EntityId self) : self_(self) {}

  // The lower one.

  /// Asks `whom`, where no other request is open and these two plans were not asked about
  /// before.
  /// @param about       its number is set here.
  /// @param round_trip  of messages to `whom` and back, the longest [s].
  void ask(Time now, EntityId whom, const YieldRequest& about, double round_trip);
  void take(Time now, EntityId from, const YieldAnswer& answer);
  /// A request is out and may still be answered.
  bool is_asking() const { return asked_ && !asked_->answered && !asked_->given_up; }
  /// Says the request once more when its time has come.
  void step(Time now, std::vector<Message>& out);

  // The higher one.

  /// What was answered to this request; to another one about a conflict in which the
  /// sender has been granted one: refused. None: it is to be decided.
  std::optional<bool> answer_to(Time now, EntityId from,
                                const YieldRequest& request) const;
  void decide(EntityId from, const YieldRequest& request, bool granted);

  // The order.

  /// The other has said that it gives way.
  bool other_yields(EntityId other, Time now) const;
  /// The own aircraft has granted it to the other.
  bool yields_to(EntityId other, Time now) const;

 private:
  struct Decided {
    YieldRequest request;
    bool granted = false;
  };

  EntityId self_;
  std::uint32_t requests_ = 0;
  std::optional<SentRequest> asked_;     // the last one
  std::map<EntityId, double> yielded_;   // by others, until then [s]
  std::map<EntityId, Decided> decided_;  // what others asked for last
};

}  // namespace skein::reasoning
