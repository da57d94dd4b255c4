#include "skein/link/modem/modem_peer.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"
#include "skein/data/walk.h"
#include "skein/data/wire.h"

namespace skein::modem {
namespace {

Time patience_of(Time advertisement_period) {
  return advertisement_period * 3;
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
      gateway_({options_.hw, options_.identities.at(0).value}, options_.method),
      queue_(options_.queue),
      jitter_(options_.session, options_.hw, Purpose::kRadio) {
  for (const EntityId each : options_.identities) {
    SKEIN_CHECK(each.value < options_.entities, each.value);
    here_[each.value] = true;
  }
}

// Where a message goes; none: nobody is reached.
std::optional<Address> ModemPeer::address_of(const Message& message) const {
  const Address station{options_.hw, own().value};
  const Node sender{{options_.hw, message.from.value}, message.from == own(), station};
  if (message.to == kEveryone)
    return neighbours_.empty() ? std::nullopt
                               : std::optional<Address>(Address{kAll, kAll});
  const auto known = gateway_.known_as(message.to);
  if (!known) return std::nullopt;
  return gateway_.way_out(sender, *known, message.to);
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

std::size_t ModemPeer::put_out(Datagram datagram, Time now, const Send& send) {
  datagram.session = options_.session;
  datagram.number = ++datagrams_;
  datagram.sent = now;
  coded_.clear();
  encode(datagram, coded_);
  if (coded_.size() > kMaxDatagram) {
    ++statistics_.dropped.full;  // no modem has room for it
    return 0;
  }
  queue_.went(coded_.size(), now);
  ++statistics_.sent;
  statistics_.sent_bytes += coded_.size();
  send(coded_);
  return coded_.size();
}

void ModemPeer::step(Time now, const Send& send) {
  std::vector<NeighbourChange> lost;
  neighbours_.step(now, lost);
  note(lost);
  if (now >= next_advertisement_ && now >= queue_.due()) {
    next_advertisement_ =
        now + Time::from_seconds(options_.advertisement_period.seconds() *
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
  while (auto waiting = queue_.take(now)) {
    const Time delay = now - waiting->since;
    const bool injected = waiting->injected;
    Datagram datagram;
    datagram.origin = waiting->origin;
    datagram.to = waiting->to;
    datagram.urgency = waiting->urgency;
    // One receiver is in the address.
    if (waiting->to.sw != kAll) waiting->carried.receivers.clear();
    datagram.payload = std::move(waiting->carried);
    if (put_out(std::move(datagram), now, send) == 0) continue;
    statistics_.injected += injected ? 1 : 0;
    statistics_.delay_sum += delay;
    statistics_.delay_most = std::max(statistics_.delay_most, delay);
    ++statistics_.delayed;
  }
}

Time ModemPeer::next() const {
  const Time due = std::max(next_advertisement_, queue_.due());
  return queue_.empty() ? due : std::min(due, queue_.due());
}

void ModemPeer::receive(std::span<const std::byte> bytes, Time now,
                        std::vector<Message>& out) {
  const auto read = decode_datagram(bytes);
  if (!read) {
    ++statistics_.unknown;
    return;
  }
  const Datagram& datagram = read.value();
  if (datagram.origin.hw == options_.hw ||
      !duplicates_.is_new(datagram.origin.hw, datagram.session, datagram.number, now)) {
    ++statistics_.duplicates;
    return;
  }
  ++statistics_.heard;
  statistics_.heard_bytes += bytes.size();
  if (const auto* advertisement = std::get_if<Advertisement>(&datagram.payload))
    take(datagram, *advertisement, now);
  else
    take(datagram, std::get<Carried>(datagram.payload), now, out);
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
    if (change.found)
      gateway_.pass_on({change.hw, change.who.value});
    else
      gateway_.forget(change.who);
    changes_.push_back(change);
  }
}

void ModemPeer::take(const Datagram& datagram, const Advertisement& said, Time now) {
  if (said.scenario != options_.scenario) {
    ++statistics_.unknown;
    return;
  }
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
  if (!neighbours_.heard(datagram.origin, now)) {
    ++statistics_.unknown;
    return;
  }
  const Time shift = shift_of(datagram, now);
  if (!is_for_us(datagram, said)) return;
  Message message = said.message;
  message.from = EntityId{datagram.origin.sw};
  if (options_.identities.size() == 1 && !options_.overhears)
    message.to = own();
  else
    message.to = datagram.to.sw == kAll ? kEveryone : EntityId{datagram.to.sw};
  walk::shift_times(message, shift);
  out.push_back(std::move(message));
}

std::vector<NeighbourChange> ModemPeer::take_changes() {
  return std::exchange(changes_, {});
}

ModemStatistics ModemPeer::statistics() const {
  ModemStatistics all = statistics_;
  all.dropped.full += queue_.losses().full;
  all.dropped.expired += queue_.losses().expired;
  all.waiting = queue_.size();
  return all;
}

}  // namespace skein::modem
