// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_peer.h"

#include <algorithm>
#include <set>
#include <utility>

#include "skein/base/check.h"
#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"

namespace skein::modem {
namespace {

Time patience_of(Time advertisement_period) {
  return advertisement_period * 3;
}

// Only with the key another session can be begun.
SessionRule session_rule(const std::optional<DatagramSeal>& seal) {
  return seal && seal->required ? SessionRule::kNewest : SessionRule::kFirst;
}

// What is said, when and by whom: the same in all copies of a message.
std::vector<std::byte> key_of(Message message) {
  message.to = kEveryone;
  message.number = 0;
  std::vector<std::byte> key;
  wire::encode(message, key);
  return key;
}

}  // namespace

ModemPeer::ModemPeer(ModemPeerOptions options)
    : options_(std::move(options)),
      here_(options_.entities),
      neighbours_(options_.entities, patience_of(options_.advertisement_period)),
      duplicates_(session_rule(options_.seal),
                  patience_of(options_.advertisement_period)),
      queue_(options_.queue),
      load_(options_.queue.rate),
      jitter_(options_.session, options_.hw, Purpose::kRadio) {
  for (const EntityId each : options_.identities) {
    SKEIN_CHECK(each.value < options_.entities, each.value);
    here_[each.value] = true;
  }
}

// Where a message goes; none: nobody is reached.
std::optional<Address> ModemPeer::address_of(const Message& message) const {
  if (message.to != kEveryone) return neighbours_.find(message.to);
  if (neighbours_.empty()) return std::nullopt;
  return Address{kAll, kAll};
}

void ModemPeer::send(const Message& message, Time now) {
  if (!is_here(message.from)) return;
  const auto to = address_of(message);
  if (!to) {
    ++statistics_.unreachable;
    return;
  }
  Waiting waiting;
  waiting.origin = {options_.hw, message.from.value};
  waiting.to = *to;
  waiting.carried.message = message;
  if (message.to != kEveryone) {
    waiting.carried.receivers.push_back(message.to.value);
    waiting.key = key_of(message);
  }
  waiting.urgency = urgency_of(message.content);
  waiting.since = now;
  queue_.put(std::move(waiting));
}

void ModemPeer::inject(const Message& message, Time now) {
  if (!is_here(message.from) || neighbours_.empty()) return;
  Waiting waiting;
  waiting.origin = {options_.hw, message.from.value};
  waiting.to = {options_.hw, message.to.value};
  waiting.carried.message = message;
  waiting.urgency = urgency_of(message.content);
  waiting.injected = true;
  waiting.since = now;
  queue_.put(std::move(waiting));
}

bool ModemPeer::put_out(Datagram datagram, Time now, const Send& send) {
  datagram.session = options_.session;
  datagram.number = ++datagrams_;
  datagram.sent = now;
  coded_.clear();
  encode(datagram, coded_);
  if (options_.seal) options_.seal->put_on(coded_, datagram.number);
  if (coded_.size() > kMaxDatagram) {
    ++statistics_.too_long;
    return false;
  }
  if (!send(coded_)) {
    ++statistics_.unsent;
    return false;
  }
  queue_.went(coded_.size(), now);
  load_.add(coded_.size(), now);
  ++statistics_.sent;
  statistics_.sent_bytes += coded_.size();
  return true;
}

void ModemPeer::advertise(Time now, const Send& send) {
  next_advertisement_ = now + Time::from_seconds(options_.advertisement_period.seconds() *
                                                 jitter_.uniform(0.9, 1.1));
  Advertisement advertisement{options_.scenario, {}};
  for (const EntityId each : options_.identities)
    advertisement.identities.push_back(each.value);
  Datagram datagram;
  datagram.origin = {options_.hw, own().value};
  datagram.to = {kAll, kAll};
  datagram.payload = std::move(advertisement);
  put_out(std::move(datagram), now, send);
}

void ModemPeer::step(Time now, const Send& send) {
  std::vector<NeighbourChange> lost;
  neighbours_.step(now, lost);
  note(lost);
  if (now >= next_advertisement_ && now >= queue_.due()) advertise(now, send);
  while (auto waiting = queue_.take(now)) {
    const Time delay = now - waiting->since;
    Datagram datagram;
    datagram.origin = waiting->origin;
    datagram.to = waiting->to;
    datagram.urgency = waiting->urgency;
    // One receiver is in the address.
    if (waiting->to.sw != kAll) waiting->carried.receivers.clear();
    datagram.payload = std::move(waiting->carried);
    if (!put_out(std::move(datagram), now, send)) continue;
    statistics_.injected += waiting->injected ? 1 : 0;
    statistics_.delay_sum += delay;
    statistics_.delay_most = std::max(statistics_.delay_most, delay);
    ++statistics_.delayed;
  }
}

Time ModemPeer::next() const {
  const Time due = std::max(next_advertisement_, queue_.due());
  return queue_.empty() ? due : std::min(due, queue_.due());
}

// What came, if it is a datagram that may count.
std::optional<Datagram> ModemPeer::open(std::span<const std::byte> bytes, Time now) {
  const auto as_read = [this](Result<Datagram> read) {
    if (read) return std::optional(std::move(read).value());
    ++statistics_.unknown;
    return std::optional<Datagram>();
  };
  if (!options_.seal) return as_read(decode_datagram(bytes));
  const DatagramSeal& seal = *options_.seal;
  const bool may_be_sealed = bytes.size() >= seal.bytes;
  const auto content = may_be_sealed ? bytes.first(bytes.size() - seal.bytes) : bytes;
  if (may_be_sealed && seal.is_authentic(bytes)) return as_read(decode_datagram(content));
  ++statistics_.unauthentic;
  // Nobody is to make it work by what does not count.
  const AlertKind kind = seal.required ? AlertKind::kRefused : AlertKind::kDoubted;
  const bool says = alerts_.note(kind, now);
  if (seal.required && !says) return std::nullopt;
  auto unsealed = decode_datagram(bytes);
  if (!unsealed) unsealed = decode_datagram(content);
  if (says) {
    std::vector<EntityId> named;
    if (unsealed) named.push_back(EntityId{unsealed.value().origin.sw});
    alerts_.say(kind, std::move(named), now);
  }
  if (seal.required) return std::nullopt;
  return as_read(std::move(unsealed));
}

// Something with the address of this modem: its own echo, or another modem has it too.
void ModemPeer::hear_own_address(const Datagram& datagram, Time now) {
  const auto* said = std::get_if<Advertisement>(&datagram.payload);
  if (datagram.session == options_.session || !said) {
    ++statistics_.duplicates;
    return;
  }
  ++statistics_.clashes;
  if (!alerts_.note(AlertKind::kSameAddress, now)) return;
  std::vector<EntityId> identities;
  for (const std::uint32_t sw : said->identities) identities.push_back(EntityId{sw});
  alerts_.say(AlertKind::kSameAddress, std::move(identities), now);
}

// Only who takes part is entered anywhere: an advertised entity of the same scenario, and
// what it says through the modem through which it is heard.
bool ModemPeer::is_of_team(const Datagram& datagram) const {
  const auto* said = std::get_if<Advertisement>(&datagram.payload);
  if (!said) return neighbours_.find(EntityId{datagram.origin.sw}) == datagram.origin;
  return said->scenario == options_.scenario &&
         std::ranges::any_of(said->identities, [&](std::uint32_t sw) {
           return !is_here(EntityId{sw}) && neighbours_.takes({datagram.origin.hw, sw});
         });
}

void ModemPeer::receive(std::span<const std::byte> bytes, Time now,
                        std::vector<Message>& out) {
  load_.add(bytes.size(), now);
  const auto datagram = open(bytes, now);
  if (!datagram) return;
  if (datagram->origin.hw == options_.hw) return hear_own_address(*datagram, now);
  if (!is_of_team(*datagram)) {
    ++statistics_.unknown;
    return;
  }
  if (!duplicates_.is_new(datagram->origin.hw, datagram->session, datagram->number,
                          now)) {
    ++statistics_.duplicates;
    return;
  }
  ++statistics_.heard;
  statistics_.heard_bytes += bytes.size();
  if (const auto* advertisement = std::get_if<Advertisement>(&datagram->payload))
    take(*datagram, *advertisement, now);
  else
    take(*datagram, std::get<Carried>(datagram->payload), now, out);
}

// Moves times of its origin's clock to this one.
Time ModemPeer::shift_of(const Datagram& datagram, Time now) {
  Clock& clock = clocks_[datagram.origin.hw];
  if (clock.session != datagram.session) clock = {datagram.session, {}};
  clock.alignment.hear(datagram.sent, now);
  return clock.alignment.to_here(datagram.sent, now) - datagram.sent;
}

void ModemPeer::note(const std::vector<NeighbourChange>& changes) {
  for (const NeighbourChange& change : changes) {
    if (!change.found && !neighbours_.reaches_through(change.hw)) {
      duplicates_.lost(change.hw);
      clocks_.erase(change.hw);
    }
    changes_.push_back(change);
  }
}

void ModemPeer::take(const Datagram& datagram, const Advertisement& said, Time now) {
  shift_of(datagram, now);
  std::vector<NeighbourChange> found;
  for (const std::uint32_t sw : said.identities)
    if (!is_here(EntityId{sw}))
      neighbours_.advertised({datagram.origin.hw, sw}, now, found);
  // Who has just come is told soon who is here.
  if (!found.empty()) next_advertisement_ = std::min(next_advertisement_, now);
  note(found);
}

bool ModemPeer::is_for_us(const Datagram& datagram, const Carried& carried) const {
  if (options_.overhears) return true;
  if (datagram.to.hw != options_.hw && datagram.to.hw != kAll) return false;
  if (datagram.to.sw != kAll) return is_here(EntityId{datagram.to.sw});
  return carried.receivers.empty() ||
         std::any_of(carried.receivers.begin(), carried.receivers.end(),
                     [this](std::uint32_t sw) { return is_here(EntityId{sw}); });
}

void ModemPeer::take(const Datagram& datagram, const Carried& said, Time now,
                     std::vector<Message>& out) {
  neighbours_.heard(datagram.origin, now);
  const Time shift = shift_of(datagram, now);
  if (!is_for_us(datagram, said)) return;
  Message message = said.message;
  message.from = EntityId{datagram.origin.sw};
  walk::shift_times(message, shift);
  const auto put = [&](EntityId to) {
    message.to = to;
    out.push_back(message);
  };
  if (options_.identities.size() == 1 && !options_.overhears) return put(own());
  if (datagram.to.sw != kAll) return put(EntityId{datagram.to.sw});
  if (said.receivers.empty()) return put(kEveryone);
  // Whoever made up the list: each entity once at most.
  const std::set<std::uint32_t> receivers(said.receivers.begin(), said.receivers.end());
  for (const std::uint32_t sw : receivers)
    if (sw < options_.entities) put(EntityId{sw});
}

std::vector<NeighbourChange> ModemPeer::take_changes() {
  return std::exchange(changes_, {});
}

ModemStatistics ModemPeer::statistics(Time now) const {
  ModemStatistics all = statistics_;
  all.dropped.full += queue_.losses().full;
  all.dropped.expired += queue_.losses().expired;
  all.waiting = queue_.size();
  all.load = load_.load(now);
  return all;
}

}  // namespace skein::modem
