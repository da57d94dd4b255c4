// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "skein/base/id.h"

namespace skein::reasoning {

/// The orders of a leader: each is acknowledged, or repeated, or reported.
///
/// A task that moves from one member to another is first taken from the one, and given to
/// the other when the first has acknowledged that, says that it does not execute it, or
/// is lost: so that nobody executes what another one still does. Until then what the
/// other shall do behind it waits too.
class TeamOrders {
 public:
  /// An order that goes out now.
  struct Sent {
    EntityId to;
    std::uint32_t number = 0;
    std::vector<std::uint32_t> tasks;
  };
  struct Outcome {
    std::vector<Sent> sent;
    std::vector<EntityId> unanswered;  ///< whose order was not acknowledged in time
  };

  explicit TeamOrders(EntityId self) : self_(self) {}

  /// What a member shall do; begins with it when it is new.
  void set(EntityId member, std::vector<std::uint32_t> tasks);
  void remove(EntityId member) { lines_.erase(member); }
  /// Forgets all members; numbers go on.
  void clear() {
    lines_.clear();
    own_.clear();
  }
  bool has(EntityId member) const { return lines_.contains(member); }

  /// A member has acknowledged an order.
  /// @returns  whether there is such an order.
  bool acknowledge(EntityId member, std::uint32_t number);
  /// A member says what it executes.
  void informed(EntityId member, std::vector<std::uint32_t> tasks);

  /// The last order shall be acknowledged once more, as sign that the member is there.
  void remind(EntityId member);

  /// What is to be sent now: new orders, and the last ones again that are not
  /// acknowledged: three times after `repeat` [s], then every `period` [s], whichever is
  /// longer; reported once after `patience` [s].
  Outcome step(double now, double repeat, double period, double patience);

  /// The own tasks, without those that another one still has.
  const std::vector<std::uint32_t>& own() const { return own_; }
  /// Whether every order was acknowledged.
  bool all_acknowledged() const;

 private:
  struct Line {
    std::vector<std::uint32_t> aim;    // what it shall do in the end
    std::vector<std::uint32_t> order;  // the last one
    std::set<std::uint32_t> open;      // of all orders since the last acknowledged one
    std::vector<std::uint32_t> informed;
    std::uint32_t number = 0;
    bool acknowledged = false, reported = false;
    bool confirmed = false;  // it was acknowledged; not asked again since it was dropped
    double first = 0, last = 0;
    int repeats = 0;
  };
  bool may_execute(const Line& line, std::uint32_t task) const;
  std::vector<std::uint32_t> possible(EntityId member, const Line& line) const;

  EntityId self_;
  std::uint32_t counter_ = 0;
  std::map<EntityId, Line> lines_;
  std::vector<std::uint32_t> own_;
};

}  // namespace skein::reasoning
