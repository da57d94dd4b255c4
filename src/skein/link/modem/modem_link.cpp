// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/modem_link.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "skein/base/log.h"
#include "skein/data/describe/walk.h"

namespace skein::modem {
namespace {

constexpr std::chrono::milliseconds kLongestTurn{10};
constexpr Time kConnecting = Time::from_ns(500'000'000);  // until a line is missed
constexpr std::size_t kMaxWaiting = 5000;                 // that nobody takes, either way

bool is_stream(const transport::EndpointAddress& address) {
  return std::holds_alternative<transport::TcpServer>(address) ||
         std::holds_alternative<transport::TcpClient>(address) ||
         std::holds_alternative<transport::SerialLine>(address);
}

EntityId whose(const Heard& heard) {
  return std::visit(
      [](const auto& each) {
        if constexpr (std::is_same_v<std::decay_t<decltype(each)>, Message>)
          return each.from;
        else
          return each.who;
      },
      heard);
}

bool is_message(const Heard& heard) {
  return std::holds_alternative<Message>(heard);
}

}  // namespace

ModemLink::ModemLink(ModemLinkOptions options)
    : options_(std::move(options)),
      stream_(is_stream(options_.endpoint)),
      here_(options_.peer.entities),
      peer_(options_.peer),
      endpoints_(*this) {
  for (const EntityId each : options_.peer.identities) here_[each.value] = true;
}

ModemLink::~ModemLink() {
  stop_ = true;
  endpoints_.wake();
  if (thread_.joinable()) thread_.join();
}

bool ModemLink::is_beyond(EntityId who) const {
  return who.value < here_.size() && !here_[who.value];
}

Time ModemLink::now() const {
  return Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_)
          .count());
}

Result<std::vector<std::string>> ModemLink::start() {
  if (auto opened = endpoints_.open(options_.endpoint); !opened) return opened.error();
  std::vector<std::string> places = endpoints_.places();
  running_ = true;
  look_at_lines();
  thread_ = std::thread([this] { run(); });
  return places;
}

void ModemLink::put(Time at, const Message& message, bool injected) {
  if (!running_) return;
  const std::lock_guard lock(mutex_);
  if (said_.size() + out_.size() < kMaxWaiting)
    said_.push_back({message, injected, at});
  else
    ++put_full_;
}

void ModemLink::flush() {
  if (!running_) return;
  {
    const std::lock_guard lock(mutex_);
    if (said_.empty()) return;
    const Time here = now();  // the same for all: copies stay alike
    for (Outgoing& each : said_) {
      walk::shift_times(each.message, here - each.at);
      out_.push_back(std::move(each));
    }
    said_.clear();
  }
  endpoints_.wake();
}

void ModemLink::to_clock(Time at, std::vector<Heard>& taken) const {
  const Time shift = at - now();
  for (Heard& each : taken)
    if (auto* message = std::get_if<Message>(&each)) walk::shift_times(*message, shift);
}

std::vector<Heard> ModemLink::take(Time at, EntityId who) {
  std::vector<Heard> taken;
  {
    const std::lock_guard lock(mutex_);
    const auto of_others = [&](const Heard& each) { return whose(each) != who; };
    const auto first = std::stable_partition(in_.begin(), in_.end(), of_others);
    taken.assign(std::move_iterator(first), std::move_iterator(in_.end()));
    in_.erase(first, in_.end());
  }
  to_clock(at, taken);
  return taken;
}

std::vector<Heard> ModemLink::take(Time at) {
  std::vector<Heard> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = std::exchange(in_, {});
  }
  to_clock(at, taken);
  return taken;
}

ModemStatistics ModemLink::statistics() const {
  const std::lock_guard lock(mutex_);
  ModemStatistics all = statistics_;
  all.put_full = put_full_;
  all.take_full = take_full_;
  return all;
}

void ModemLink::run() {
  while (!stop_) {
    const auto until = std::chrono::nanoseconds((peer_.next() - now()).ns());
    endpoints_.run_for(std::clamp(std::chrono::ceil<std::chrono::milliseconds>(until),
                                  std::chrono::milliseconds(0), kLongestTurn));
    step();
  }
}

void ModemLink::step() {
  std::vector<Outgoing> out;
  {
    const std::lock_guard lock(mutex_);
    out = std::exchange(out_, {});
  }
  for (const Outgoing& each : out) {
    if (each.injected)
      peer_.inject(each.message, now());
    else
      peer_.send(each.message, now());
  }
  peer_.step(now(), [this](auto bytes) { return send_to_all(bytes); });
  look_at_lines();
  hand_in();
}

// Datagrams need no line; a server has none until somebody connects.
void ModemLink::look_at_lines() {
  const auto& endpoint = options_.endpoint;
  if (!channels_.empty() || std::holds_alternative<transport::SerialLine>(endpoint) ||
      (std::holds_alternative<transport::TcpClient>(endpoint) && now() > kConnecting))
    awaits_line_ = true;
  if (!stream_ || !awaits_line_) return;
  if (const auto kind = lines_.look(!channels_.empty(), now())) {
    const std::lock_guard lock(mutex_);
    hand_in({*kind, {}, 1});
  }
}

bool ModemLink::send_to_all(std::span<const std::byte> bytes) {
  std::vector<std::byte> frame;
  if (stream_) frame = in_frame(bytes);
  bool sent = false;
  for (const auto& [channel, ignored] : channels_)
    sent |= endpoints_.send(channel, stream_ ? std::span<const std::byte>(frame) : bytes);
  return sent;
}

void ModemLink::opened(transport::ChannelId channel, transport::EndpointId,
                       const std::string&) {
  channels_[channel];
}

void ModemLink::closed(transport::ChannelId channel, const std::string&) {
  channels_.erase(channel);
}

void ModemLink::received(transport::ChannelId channel, std::span<const std::byte> bytes) {
  const auto take = [this](std::span<const std::byte> datagram) {
    peer_.receive(datagram, now(), arrived_);
  };
  if (stream_) {
    StreamFrames& frames = channels_[channel].frames;
    const std::uint64_t before = frames.damaged();
    frames.read(bytes, take);
    damaged_ += frames.damaged() - before;
  } else {
    take(bytes);
  }
  hand_in();
}

// Gives what the peer has found and heard to the simulation.
void ModemLink::hand_in() {
  const std::vector<NeighbourChange> changes = peer_.take_changes();
  const std::vector<Alert> alerts = peer_.take_alerts();
  const std::lock_guard lock(mutex_);
  statistics_ = peer_.statistics(now());
  statistics_.damaged = damaged_;
  // Who speaks was found before.
  for (const NeighbourChange& change : changes) hand_in(change);
  for (const Alert& alert : alerts) hand_in(alert);
  if (arrived_.empty()) return;
  auto waiting = static_cast<std::size_t>(std::ranges::count_if(in_, is_message));
  for (Message& message : arrived_) {
    if (waiting < kMaxWaiting) {
      ++waiting;
    } else {
      in_.erase(std::ranges::find_if(in_, is_message));
      ++take_full_;
    }
    in_.emplace_back(std::move(message));
  }
  arrived_.clear();
}

// A change takes one away that it undoes: of a simulation that stands still it is enough
// to know what is.
void ModemLink::hand_in(const NeighbourChange& change) {
  const auto undone = std::ranges::find_if(in_, [&](const Heard& each) {
    const auto* other = std::get_if<NeighbourChange>(&each);
    return other && other->who == change.who;
  });
  if (undone == in_.end())
    in_.emplace_back(change);
  else
    in_.erase(undone);
}

// Who is named, or else the first of those beyond: nobody knows who it is.
EntityId ModemLink::whom_it_concerns(const Alert& alert) const {
  const auto beyond = [this](EntityId who) { return is_beyond(who); };
  const auto who = std::ranges::find_if(alert.identities, beyond);
  if (who != alert.identities.end()) return *who;
  const auto first = std::ranges::find(here_, false);
  return EntityId{static_cast<std::uint32_t>(first - here_.begin())};
}

void ModemLink::hand_in(const Alert& alert) {
  if (alert.kind == AlertKind::kSameAddress)
    log_warning(
        "another modem has the address of this one, hw {}: neither hears what the other "
        "says.",
        hw());
  const std::string place = transport::text_of(options_.endpoint);
  if (alert.kind == AlertKind::kNoLine)
    log_warning("no line to the modem at {} is open: nothing goes out or comes in.",
                place);
  if (alert.kind == AlertKind::kLineOpen)
    log_info("a line to the modem at {} is open.", place);
  const EntityId who = whom_it_concerns(alert);
  const auto waiting = [&](AlertKind kind) {
    return std::ranges::find_if(in_, [&, kind](const Heard& each) {
      const auto* other = std::get_if<ModemAlert>(&each);
      return other && other->who == who && other->kind == kind;
    });
  };
  // As a change of neighbours: of lines it is enough to know what is.
  if (const auto lost = waiting(AlertKind::kNoLine);
      alert.kind == AlertKind::kLineOpen && lost != in_.end()) {
    in_.erase(lost);
    return;
  }
  if (is_beyond(who) && waiting(alert.kind) == in_.end())
    in_.emplace_back(ModemAlert{who, hw(), alert.kind, alert.count});
}

}  // namespace skein::modem
