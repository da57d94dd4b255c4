#include "skein/link/modem/modem_link.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "skein/data/walk.h"

namespace skein::modem {
namespace {

constexpr std::chrono::milliseconds kLongestTurn{10};
constexpr std::size_t kMaxWaiting = 5000;  // that nobody takes, either way

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

// Messages give way before changes, for the simulation acts on them.
void drop_one(std::vector<Heard>& waiting) {
  const auto oldest = std::ranges::find_if(
      waiting, [](const Heard& each) { return std::holds_alternative<Message>(each); });
  waiting.erase(oldest == waiting.end() ? waiting.begin() : oldest);
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
  thread_ = std::thread([this] { run(); });
  return places;
}

void ModemLink::put(Time at, const Message& message, bool injected) {
  if (!running_) return;
  Outgoing outgoing{message, injected};
  walk::shift_times(outgoing.message, now() - at);
  {
    const std::lock_guard lock(mutex_);
    if (out_.size() < kMaxWaiting) out_.push_back(std::move(outgoing));
  }
  endpoints_.wake();
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
  const Time shift = at - now();
  for (Heard& each : taken)
    if (auto* message = std::get_if<Message>(&each)) walk::shift_times(*message, shift);
  return taken;
}

std::vector<Heard> ModemLink::take(Time at) {
  std::vector<Heard> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = std::exchange(in_, {});
  }
  const Time shift = at - now();
  for (Heard& each : taken)
    if (auto* message = std::get_if<Message>(&each)) walk::shift_times(*message, shift);
  return taken;
}

ModemStatistics ModemLink::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
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
  peer_.step(now(), [this](auto bytes) { send_to_all(bytes); });
  std::vector<NeighbourChange> changes = peer_.take_changes();
  const std::lock_guard lock(mutex_);
  statistics_ = peer_.statistics();
  for (const NeighbourChange& change : changes) in_.emplace_back(change);
}

void ModemLink::send_to_all(std::span<const std::byte> bytes) {
  std::vector<std::byte> frame;
  if (stream_) frame = in_frame(bytes);
  for (const auto& [channel, ignored] : channels_)
    endpoints_.send(channel, stream_ ? std::span<const std::byte>(frame) : bytes);
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
  if (stream_)
    channels_[channel].frames.read(bytes, take);
  else
    take(bytes);
  std::vector<NeighbourChange> changes = peer_.take_changes();
  const std::lock_guard lock(mutex_);
  // Who speaks was found before.
  for (const NeighbourChange& change : changes) in_.emplace_back(change);
  for (Message& message : arrived_) {
    if (in_.size() >= kMaxWaiting) drop_one(in_);
    in_.emplace_back(std::move(message));
  }
  arrived_.clear();
}

}  // namespace skein::modem
