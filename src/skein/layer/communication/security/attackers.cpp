// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/security/attackers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/base/math.h"
#include "skein/data/describe/wire.h"
#include "skein/layer/communication/security/seal.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kAttacks = 8;  // of a node's random streams for its radio
// Noise goes in pieces: who it reaches changes as aircraft move.
constexpr Time kNoisePiece = Time::from_ns(100'000'000);
constexpr std::size_t kMaxRecorded = 10'000;  // messages that a replayer has room for
// Above all that stations give, who count from 1.
constexpr std::uint32_t kHighOrder = 4'000'000'000;

const char* kind_of(const Attack& attack) {
  struct Word {
    const char* operator()(const Jammer&) { return "jammer"; }
    const char* operator()(const Flooder&) { return "flooder"; }
    const char* operator()(const Spoofer&) { return "spoofer"; }
    const char* operator()(const Replayer&) { return "replayer"; }
  };
  return std::visit(Word(), attack.what);
}

}  // namespace

Attackers::Attackers(std::vector<Attack> attacks, NodeIndex first, Place place,
                     bool sealed, std::uint64_t seed)
    : first_(first), place_(std::move(place)), sealed_(sealed) {
  for (Attack& attack : attacks) {
    const auto node = first_ + static_cast<NodeIndex>(all_.size());
    listen_ = listen_ || std::holds_alternative<Replayer>(attack.what);
    Attacker attacker{std::move(attack),
                      RandomStream(seed, node, Purpose::kRadio, kAttacks),
                      Time(),
                      false,
                      false,
                      0,
                      {},
                      {}};
    attacker.next = attacker.attack.from;
    all_.push_back(std::move(attacker));
  }
}

void Attackers::step(Time now, AttackOrders& orders, std::vector<Event>& events) {
  for (std::size_t k = 0; k < all_.size(); ++k) {
    Attacker& attacker = all_[k];
    const NodeIndex node = first_ + static_cast<NodeIndex>(k);
    announce(attacker, now, events);
    // The last moment that it may begin to send at.
    const Time last = attacker.attack.until
                          ? std::min(now, *attacker.attack.until - Time::from_ns(1))
                          : now;
    struct Doing {
      Attackers& all;
      Attacker& attacker;
      NodeIndex node;
      Time last;
      AttackOrders& orders;
      void operator()(const Jammer& j) { all.jam(attacker, node, j, last, orders); }
      void operator()(const Flooder& f) { all.flood(attacker, node, f, last, orders); }
      void operator()(const Spoofer& s) { all.spoof(attacker, node, s, last, orders); }
      void operator()(const Replayer&) { all.replay(attacker, node, last, orders); }
    };
    std::visit(Doing{*this, attacker, node, last, orders}, attacker.attack.what);
  }
}

void Attackers::announce(Attacker& attacker, Time now, std::vector<Event>& events) {
  const Attack& attack = attacker.attack;
  const auto say = [&](EventKind event) {
    events.push_back({now, EntityId{}, event,
                      fmt::format("{} ({}) at {:.0f}, {:.0f} m, {:.4g} dBm", attack.name,
                                  kind_of(attack), attack.place.x(), attack.place.y(),
                                  attack.power_dbm)});
  };
  if (!attacker.begun && attack.from <= now) {
    attacker.begun = true;
    say(EventKind::kAttackBegins);
  }
  if (attacker.begun && !attacker.ended && attack.until && *attack.until <= now) {
    attacker.ended = true;
    say(EventKind::kAttackEnds);
  }
}

void Attackers::jam(Attacker& attacker, NodeIndex node, const Jammer& jammer, Time last,
                    AttackOrders& orders) {
  const Attack& attack = attacker.attack;
  const Time burst = std::max(Time::from_ns(1),
                              Time::from_seconds(jammer.duty * jammer.period.seconds()));
  while (attacker.next <= last) {
    const std::int64_t periods = (attacker.next - attack.from).ns() / jammer.period.ns();
    const Time begin = attack.from + jammer.period * periods;
    Time end = std::min(begin + burst, attacker.next + kNoisePiece);
    if (attack.until) end = std::min(end, *attack.until);
    orders.noise.push_back({node, attacker.next, end - attacker.next});
    attacker.next = end < begin + burst ? end : begin + jammer.period;
  }
}

void Attackers::flood(Attacker& attacker, NodeIndex node, const Flooder& flooder,
                      Time last, AttackOrders& orders) {
  const Time interval = Time::from_seconds(1 / flooder.rate);
  for (; attacker.next <= last; attacker.next += interval)
    orders.packets.push_back(
        {node, attacker.next, flooder.to ? flooder.to->value : kAllNodes, flooder.bytes});
}

void Attackers::spoof(Attacker& attacker, NodeIndex node, const Spoofer& spoofer,
                      Time last, AttackOrders& orders) {
  for (; attacker.next <= last; attacker.next += spoofer.period) {
    auto content = lie(attacker, spoofer, attacker.next);
    if (!content) continue;
    Message message;
    message.from = spoofer.as;
    message.to = spoofer.to;
    message.number = attacker.sent++;
    message.sent = attacker.next;
    message.content = *std::move(content);
    message.forged = true;
    AirMessage forged;
    if (sealed_) {
      wire::encode(message, forged.sealed);
      for (std::size_t k = 0; k < Seal::kBytes; ++k)
        forged.sealed.push_back(static_cast<std::byte>(attacker.random.bits() & 0xFFU));
    }
    forged.copies.push_back(std::move(message));
    orders.forgeries.push_back({node, attacker.next, std::move(forged)});
  }
}

// What a spoofer says; nothing where its victim has no place.
std::optional<MessageContent> Attackers::lie(Attacker& attacker, const Spoofer& spoofer,
                                             Time time) {
  if (spoofer.content == FalseContent::kReturnHome)
    return Task{kHighOrder + attacker.sent, ReturnHome{}};
  const auto place = place_(spoofer.as);
  if (!place) return std::nullopt;
  NavEstimate nav;
  nav.time = time;
  nav.p_N = *place + spoofer.offset;
  if (attacker.seen && attacker.seen->first < time)
    nav.v_N = (*place - attacker.seen->second) / (time - attacker.seen->first).seconds();
  nav.heading = math::atan2(nav.v_N.y(), nav.v_N.x());
  attacker.seen = {time, *place};
  if (spoofer.content == FalseContent::kTeamPosition)
    return TeamPosition{spoofer.as, nav};
  AircraftReport report;
  report.nav = nav;
  return report;
}

void Attackers::replay(Attacker& attacker, NodeIndex node, Time last,
                       AttackOrders& orders) {
  auto& recorded = attacker.recorded;
  for (; !recorded.empty() && recorded.front().again <= last; recorded.pop_front())
    orders.forgeries.push_back(
        {node, recorded.front().again, std::move(recorded.front().message)});
}

void Attackers::overhear(NodeIndex node, std::span<const Message> copies,
                         std::span<const std::byte> sealed, Time now) {
  Attacker& attacker = all_[node - first_];
  const auto* replayer = std::get_if<Replayer>(&attacker.attack.what);
  const Attack& attack = attacker.attack;
  if (!replayer || copies.empty() || copies[0].forged ||
      attacker.recorded.size() >= kMaxRecorded)
    return;
  if (now < attack.from || (attack.until && now >= *attack.until)) return;
  if (replayer->of && copies[0].from != *replayer->of) return;
  const auto again = [&](const Recorded& each) {
    const Message& first = each.message.copies[0];
    return first.from == copies[0].from && first.number == copies[0].number;
  };
  // It was sent again because nobody acknowledged it.
  if (std::ranges::any_of(attacker.recorded, again)) return;
  Recorded& made = attacker.recorded.emplace_back();
  made.again = now + replayer->delay;
  made.message.copies.assign(copies.begin(), copies.end());
  for (Message& copy : made.message.copies) copy.forged = true;
  made.message.sealed.assign(sealed.begin(), sealed.end());
}

}  // namespace skein::communication
