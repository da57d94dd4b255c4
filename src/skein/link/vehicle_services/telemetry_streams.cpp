// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/telemetry_streams.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::vehicle_services {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kMinInterval = 5'000'000;
constexpr std::int64_t kMaxInterval = 3600 * kSecond;
constexpr std::int64_t kMaxHurry = 10;
constexpr Time kNever = Time::from_ns(std::numeric_limits<std::int64_t>::max());

constexpr auto kHeartbeatRow = std::size_t{0};

std::int64_t allowed_interval_ns(double interval_ns) {
  return std::llround(std::clamp(interval_ns, static_cast<double>(kMinInterval),
                                 static_cast<double>(kMaxInterval)));
}

}  // namespace

TelemetryStreams::TelemetryStreams(Make make, std::uint8_t system)
    : make_(make), system_(system) {}

const TelemetryStreams::Link* TelemetryStreams::find(Channel channel) const {
  const auto found = std::ranges::find(links_, channel, &Link::channel);
  return found == links_.end() ? nullptr : &*found;
}

TelemetryStreams::Link* TelemetryStreams::find(Channel channel) {
  const auto found = std::ranges::find(links_, channel, &Link::channel);
  return found == links_.end() ? nullptr : &*found;
}

std::int64_t TelemetryStreams::own_interval_ns(std::size_t row) const {
  const TelemetryRow& entry = telemetry_rows()[row];
  const float rate = make_ == Make::kPx4 ? entry.rate_px4 : entry.rate_ardupilot;
  return rate > 0 ? std::llround(1e9 / static_cast<double>(rate)) : 0;
}

void TelemetryStreams::set(Link& link, std::size_t row, std::int64_t interval_ns,
                           Time simulated) const {
  Stream& stream = link.streams[row];
  stream.interval_ns = interval_ns;
  // Streams and vehicles begin at different times, so that they do not come in bursts.
  const auto phase =
      static_cast<std::int64_t>((std::size_t{system_} * 61 + row * 37) % 100);
  stream.due = simulated + Time::from_ns(std::min(interval_ns, kSecond) / 100 * phase);
  link.next = std::min(link.next, stream.due);
}

void TelemetryStreams::change(Link& link, std::size_t row, std::int64_t interval_ns,
                              Time simulated) const {
  // Some ask for the same again and again.
  if (link.streams[row].interval_ns != interval_ns)
    set(link, row, interval_ns, simulated);
}

void TelemetryStreams::open(Channel channel, Time simulated) {
  close(channel);
  Link& link = links_.emplace_back();
  link.channel = channel;
  link.next = kNever;
  for (std::size_t row = 0; row < kTelemetryRows; ++row)
    set(link, row, own_interval_ns(row), simulated);
}

void TelemetryStreams::close(Channel channel) {
  std::erase_if(links_, [&](const Link& link) { return link.channel == channel; });
}

bool TelemetryStreams::set_interval(Channel channel, std::uint32_t id, double interval_us,
                                    Time simulated) {
  const auto row = telemetry_row_of(id, make_);
  Link* link = find(channel);
  if (!row || *row == kHeartbeatRow || !link || std::isnan(interval_us)) return false;
  change(*link, *row,
         interval_us < 0    ? 0
         : interval_us == 0 ? own_interval_ns(*row)
                            : allowed_interval_ns(interval_us * 1000),
         simulated);
  return true;
}

std::int32_t TelemetryStreams::interval_us(Channel channel, std::uint32_t id) const {
  const auto row = telemetry_row_of(id, make_);
  const Link* link = find(channel);
  if (!row || !link) return 0;
  if (*row == kHeartbeatRow) return 1'000'000;
  const std::int64_t interval_ns = link->streams[*row].interval_ns;
  return interval_ns == 0 ? -1 : static_cast<std::int32_t>(interval_ns / 1000);
}

void TelemetryStreams::set_group(Channel channel, mavlink::StreamGroup group, double rate,
                                 Time simulated) {
  Link* link = find(channel);
  if (!link) return;
  const std::int64_t interval_ns = rate > 0 ? allowed_interval_ns(1e9 / rate) : 0;
  for (std::size_t row = 0; row < kTelemetryRows; ++row) {
    const TelemetryRow& entry = telemetry_rows()[row];
    if (entry.group == mavlink::StreamGroup::kAll) continue;
    if (group != mavlink::StreamGroup::kAll && group != entry.group) continue;
    if (telemetry_row_of(entry.id, make_)) change(*link, row, interval_ns, simulated);
  }
}

void TelemetryStreams::step(const ServedVehicle& vehicle, Outbox& out) {
  const Time simulated = vehicle.now.simulated;
  const bool began_anew = simulated < last_;
  last_ = simulated;
  for (Link& link : links_) {
    if (began_anew)
      for (std::size_t row = 0; row < kTelemetryRows; ++row)
        set(link, row, link.streams[row].interval_ns, simulated);
    if (link.next <= simulated) send_due(link, vehicle, out);
  }
}

void TelemetryStreams::send_due(Link& link, const ServedVehicle& vehicle,
                                Outbox& out) const {
  const Clocks& now = vehicle.now;
  link.next = kNever;
  for (std::size_t row = 0; row < kTelemetryRows; ++row) {
    Stream& stream = link.streams[row];
    if (stream.interval_ns == 0) continue;
    if (stream.due <= now.simulated &&
        now.wall - stream.last_wall >= Time::from_ns(stream.interval_ns / kMaxHurry)) {
      telemetry_rows()[row].send(vehicle, out, link.channel);
      // In step with the clock, and without catching up.
      stream.due += Time::from_ns(stream.interval_ns);
      if (stream.due <= now.simulated)
        stream.due = now.simulated + Time::from_ns(stream.interval_ns);
      stream.last_wall = now.wall;
    }
    link.next = std::min(link.next, stream.due);
  }
}

}  // namespace skein::vehicle_services
