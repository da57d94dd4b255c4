// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_simulator.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::physics {
namespace {

using namespace std::chrono_literals;

constexpr auto kHeartbeatInterval = 1s;
constexpr auto kLook = 100ms;     // between looks whether one is due
constexpr int kMaxEvents = 1000;  // of what happens, before the step goes on

std::int64_t whole_microseconds(Time time) {
  return time.ns() / 1000;
}

}  // namespace

Result<std::unique_ptr<HilSimulator>> HilSimulator::open(const HilOptions& options) {
  std::unique_ptr<HilSimulator> simulator(new HilSimulator(options));
  if (const auto opened = simulator->endpoints_.open(options.at); !opened)
    return opened.error();
  return simulator;
}

std::string HilSimulator::place() const {
  const auto places = endpoints_.places();
  return places.empty() ? std::string() : places.front();
}

void HilSimulator::opened(transport::ChannelId channel, transport::EndpointId,
                          const std::string&) {
  channel_ = channel;
  session_.emplace(options_.system, options_.component,
                   [this](std::span<const std::byte> bytes) { send_out(bytes); });
  controls_ = {};
  answers_ = false;
  ++counts_.connections;
  heartbeat_due_ = Clock::now();
}

void HilSimulator::received(transport::ChannelId channel,
                            std::span<const std::byte> bytes) {
  if (session_ && channel == channel_) session_->received(bytes);
}

void HilSimulator::closed(transport::ChannelId channel, const std::string&) {
  if (channel != channel_) return;
  session_.reset();
  controls_ = {};
  answers_ = false;
}

void HilSimulator::send_out(std::span<const std::byte> bytes) {
  if (!endpoints_.send(channel_, bytes)) ++counts_.dropped;
}

void HilSimulator::send(const HilFix& fix) {
  if (session_) session_->send(fix);
}
void HilSimulator::send(const HilSensors& more) {
  SKEIN_CHECK(more.unit > 0);
  if (session_) session_->send(more);
}
void HilSimulator::send(const HilTruth& truth) {
  if (session_) session_->send(truth);
}

HilReply HilSimulator::step(const HilSensors& sensors,
                            std::chrono::milliseconds patience) {
  SKEIN_CHECK(sensors.unit == 0);
  SKEIN_CHECK(whole_microseconds(sensors.time) > whole_microseconds(last_time_));
  const Time length = sensors.time - std::exchange(last_time_, sensors.time);
  handle_waiting();
  send_due_heartbeat();
  // In lock-step what comes before the sensors go out is late: no answer to them.
  const bool late = take_controls();
  if (session_) session_->send(sensors);
  handle_waiting();  // more is sent when what went before is out
  const bool expected = answers_;
  const bool news = options_.lock_step ? wait_for_controls(deadline(length, patience))
                                       : take_controls() || late;
  if (!session_) return {};
  if (news) {
    ++counts_.controls;
    return {HilOutcome::kControls, controls_};
  }
  if (!options_.lock_step || !expected) return {HilOutcome::kNoControls, controls_};
  answers_ = false;
  ++counts_.timeouts;
  return {HilOutcome::kTimedOut, controls_};
}

HilSimulator::Clock::time_point HilSimulator::deadline(
    Time length, std::chrono::milliseconds patience) {
  const Clock::time_point now = Clock::now();
  if (answers_) return now + patience;
  pace_ = std::max(pace_ + std::chrono::nanoseconds(length.ns()), now);
  return std::min(pace_, now + patience);
}

bool HilSimulator::wait_for_controls(Clock::time_point until) {
  while (session_) {
    if (take_controls()) return true;
    const auto left = until - Clock::now();
    if (left <= 0ns) return false;
    endpoints_.run_one_for(left);
  }
  return false;
}

bool HilSimulator::take_controls() {
  auto controls = session_ ? session_->take_controls() : std::nullopt;
  if (!controls) return false;
  controls_ = *controls;
  answers_ = true;
  return true;
}

void HilSimulator::handle_waiting() {
  // A bound, for a peer that never stops.
  for (int k = 0; k < kMaxEvents && endpoints_.run_one_for(0ns); ++k) {
  }
}

void HilSimulator::serve(std::chrono::milliseconds duration) {
  const Clock::time_point until = Clock::now() + duration;
  handle_waiting();
  for (;;) {
    send_due_heartbeat();
    const Clock::duration left = until - Clock::now();
    if (left <= 0ns) return;
    endpoints_.run_one_for(std::min<Clock::duration>(left, kLook));
  }
}

void HilSimulator::send_due_heartbeat() {
  const Clock::time_point now = Clock::now();
  if (!session_ || now < heartbeat_due_) return;
  heartbeat_due_ = now + kHeartbeatInterval;
  session_->send_heartbeat();
}

}  // namespace skein::physics
