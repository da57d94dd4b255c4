// SPDX-License-Identifier: Apache-2.0
#include "skein/link/relay/relay_core.h"

#include <fmt/format.h>

#include <boost/asio/executor_work_guard.hpp>

namespace skein::relay {

using impairment::Direction;
using impairment::index_of;
using impairment::kDirections;
using Clock = std::chrono::steady_clock;

DirectionReport& DirectionReport::operator+=(const DirectionReport& other) {
  counts += other.counts;
  waiting_packets += other.waiting_packets;
  waiting_bytes += other.waiting_bytes;
  under_way += other.under_way;
  refused += other.refused;
  unsent += other.unsent;
  return *this;
}

RelayCore::RelayCore(const RelayOptions& options, RelayNews news)
    : options_(options),
      news_(std::move(news)),
      schedule_(options.plan),
      plan_timer_(io_) {
  wait_for_plan();
}

Time RelayCore::now() {
  const Time now = Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_)
          .count());
  while (const auto next = schedule_.next()) {
    if (*next > now) break;
    schedule_.step();
    set_all(*next);
  }
  return now;
}

void RelayCore::run_for(std::chrono::milliseconds duration) {
  const auto work = boost::asio::make_work_guard(io_);
  io_.restart();
  io_.run_for(duration);
}

void RelayCore::change(impairment::Directions directions,
                       const impairment::ImpairmentChange& change) {
  const Time at = now();
  schedule_.change(directions, change);
  set_all(at);
  pump_all();
}

void RelayCore::cut(impairment::Directions directions, Time length) {
  const Time at = now();
  for (const Direction direction : kDirections) {
    if (!includes(directions, direction)) continue;
    cut_until_[index_of(direction)] = at + length;
    for (const auto& [number, session] : sessions_)
      session->channel(direction).cut(at, at + length);
  }
  pump_all();
}

void RelayCore::reset() {
  const Time at = now();
  schedule_.reset();
  cut_until_ = {};
  for (const auto& [number, session] : sessions_)
    for (const Direction direction : kDirections) session->channel(direction).cut(at, at);
  set_all(at);
  pump_all();
}

impairment::ImpairedChannel RelayCore::make_channel(impairment::Traffic traffic,
                                                    std::uint32_t session,
                                                    Direction direction) const {
  const auto instance = static_cast<std::uint32_t>(index_of(direction));
  // One stream of outages for all: it is one radio that fails.
  const Outages outages(options_.plan.outages,
                        RandomStream(options_.seed, 0, Purpose::kRadioOutage));
  impairment::ImpairedChannel channel(
      traffic, schedule_.in_force(direction),
      RandomStream(options_.seed, session, Purpose::kRadio, instance), outages);
  channel.cut(Time(), cut_until_[index_of(direction)]);
  return channel;
}

void RelayCore::add(std::uint32_t number, const std::shared_ptr<Session>& session) {
  sessions_.emplace(number, session);
  ++report_.sessions;
  news_(fmt::format("session {} with {} begins", number, session->report().name));
}

void RelayCore::remove(std::uint32_t number, const std::string& why) {
  const auto found = sessions_.find(number);
  if (found == sessions_.end()) return;
  SessionReport last = found->second->report();
  sessions_.erase(found);
  for (const Direction direction : kDirections) {
    DirectionReport& ended = last.directions[index_of(direction)];
    report_.directions[index_of(direction)] += ended;
  }
  news_(fmt::format("session {} with {} ends: {}", number, last.name, why));
  if (ended_.size() >= Relay::kMaxSessions) ended_.erase(ended_.begin());
  ended_.push_back(std::move(last));
}

void RelayCore::stop() {
  for (const auto& [number, session] : sessions_) session->stop();
}

RelayReport RelayCore::report() const {
  RelayReport report = report_;
  report.open = static_cast<std::uint32_t>(sessions_.size());
  for (const auto& [number, session] : sessions_) {
    const SessionReport one = session->report();
    for (std::size_t k = 0; k < one.directions.size(); ++k)
      report.directions[k] += one.directions[k];
  }
  return report;
}

std::vector<SessionReport> RelayCore::sessions() const {
  std::vector<SessionReport> all;
  for (const auto& [number, session] : sessions_) all.push_back(session->report());
  return all;
}

void RelayCore::set_all(Time now) {
  for (const auto& [number, session] : sessions_)
    for (const Direction direction : kDirections)
      session->channel(direction).set(schedule_.in_force(direction), now);
}

void RelayCore::pump_all() {
  // A session may end by it.
  const auto all = sessions_;
  for (const auto& [number, session] : all) session->pump();
}

void RelayCore::wait_for_plan() {
  const auto next = schedule_.next();
  if (!next) return;
  plan_timer_.expires_at(begin_ + std::chrono::nanoseconds(next->ns()));
  plan_timer_.async_wait([this](boost::system::error_code error) {
    if (error) return;
    now();
    pump_all();
    wait_for_plan();
  });
}

}  // namespace skein::relay
