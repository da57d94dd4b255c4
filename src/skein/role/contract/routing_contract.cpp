// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <deque>
#include <vector>

#include "skein/role/contract/checks.h"
#include "skein/role/routing.h"

namespace skein::contract {
namespace {

constexpr std::uint32_t kNodes = kRoutingEntities;

enum class Shape { kRow, kRing, kGroup };

HeardLately ears_of(Shape shape) {
  return [shape](EntityId node, EntityId other) {
    if (node == other) return false;
    const std::uint32_t apart =
        node > other ? node.value - other.value : other.value - node.value;
    return shape == Shape::kGroup || apart == 1 ||
           (shape == Shape::kRing && apart == kNodes - 1);
  };
}

// One after the other, messages of all to all and everybody, along what a routing says.
class Walk {
 public:
  Walk(Routing& routing, Shape shape, Checks& checks)
      : routing_(routing), receives_(ears_of(shape)), checks_(checks) {}

  // What was asked for, in order: whom to send to, nobody as the number of nodes.
  std::vector<std::uint32_t> pass() {
    RandomStream random = draws(31);
    for (int k = 0; k < 300; ++k) {
      now_ += Time::from_seconds(random.uniform());
      const auto from = static_cast<std::uint32_t>(random.uniform(0, kNodes));
      const auto to = static_cast<std::uint32_t>(random.uniform(0, kNodes + 1));
      if (to != from) pass({EntityId{from}, to == kNodes ? kEveryone : EntityId{to}, 0});
    }
    return std::move(said_);
  }

 private:
  struct Carrier {
    EntityId node;
    std::uint32_t hops;
  };

  std::optional<EntityId> ask(EntityId node, const RoutedMessage& message) {
    const auto next = routing_.next(node, message, receives_, now_);
    said_.push_back(next ? next->value : kNodes);
    const bool known = !next || *next == kEveryone || next->value < kNodes;
    checks_.expect(known, "it sends to nobody who takes part");
    checks_.expect(next != node, "it sends to itself");
    checks_.expect(!next || !known || *next == kEveryone || *next == message.to ||
                       receives_(node, *next),
                   "it sends by way of somebody whom the sender does not hear");
    return known ? next : std::nullopt;
  }

  void pass(const RoutedMessage& message) {
    std::vector<bool> reached(kNodes, false);
    reached[message.origin.value] = true;
    std::deque<Carrier> carriers{{message.origin, 0}};
    while (!carriers.empty()) {
      const Carrier carrier = carriers.front();
      carriers.pop_front();
      const auto next = ask(carrier.node, {message.origin, message.to, carrier.hops});
      if (!next) continue;
      for (std::uint32_t k = 0; k < kNodes; ++k) {
        const EntityId node{k};
        if ((*next != kEveryone && *next != node) || !receives_(node, carrier.node))
          continue;
        routing_.learn(node, carrier.node, {message.origin, message.to, carrier.hops},
                       now_);
        if (reached[k]) continue;
        reached[k] = true;
        const double delay = routing_.delay(node);
        checks_.expect(std::isfinite(delay) && delay >= 0,
                       "it waits a time that is negative or no number");
        if (message.to != node) carriers.push_back({node, carrier.hops + 1});
      }
    }
    checks_.expect(message.to == kEveryone || !receives_(message.origin, message.to) ||
                       reached[message.to.value],
                   "a receiver that its sender hears is not reached");
  }

  Routing& routing_;
  HeardLately receives_;
  Checks& checks_;
  Time now_;
  std::vector<std::uint32_t> said_;
};

}  // namespace

Violations routing_violations(const Make<Routing>& make) {
  Checks checks;
  for (const Shape shape : {Shape::kRow, Shape::kRing, Shape::kGroup}) {
    const auto routing = make(), twin = make();
    const auto one = Walk(*routing, shape, checks).pass();
    const auto other = Walk(*twin, shape, checks).pass();
    checks.expect(one == other, "two equal ones route the same messages differently");
    checks.expect(routing->head_bytes() <= 1000, "it adds over 1000 bytes to a message");
  }
  return checks.take();
}

}  // namespace skein::contract
