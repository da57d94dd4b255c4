// SPDX-License-Identifier: Apache-2.0
#include "app/study/mixed_network/mixed_network.h"

#include <algorithm>
#include <thread>

#include "skein/base/check.h"
#include "skein/layer/communication/ideal_radio.h"

namespace skein::mixed_network {
namespace {

constexpr std::chrono::milliseconds kMixedTurn{2};
constexpr double kMeeting = 10;  // in which all have met [s]

}  // namespace

MixedNetwork::MixedNetwork(MixedNetworkOptions options) : options_(std::move(options)) {
  SKEIN_CHECK(options_.places.size() == options_.real.size(), options_.real.size());
  std::vector<Vec3> modems;
  for (std::uint32_t k = 0; k < options_.places.size(); ++k) {
    if (options_.real[k]) modems.push_back(options_.places[k]);
    (options_.real[k] ? real_ : simulated_).push_back(EntityId{k});
  }
  if (!simulated_.empty()) modems.push_back(options_.station);
  air_ = std::make_unique<ModemAir>(options_.radio, std::move(modems), options_.seed);
  if (simulated_.empty()) return;
  if (options_.simulated == SimulatedAir::kMedium)
    medium_ = standing_radio(options_.radio, options_.places, options_.seed + 1000);
  else
    medium_ = std::make_unique<communication::IdealRadio>(
        communication::IdealRadioOptions{}, options_.seed, nullptr);
}

Time MixedNetwork::now() const {
  return Time::from_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(
                           std::chrono::steady_clock::now() - begin_)
                           .count());
}

Result<void> MixedNetwork::open(const transport::EndpointAddress& air,
                                std::vector<EntityId> identities) {
  const bool is_station = identities == simulated_;
  modem::ModemLinkOptions options;
  options.endpoint = air;
  options.peer.hw = static_cast<std::uint32_t>(modems_.size() + 1);
  options.peer.session = options_.seed + 1;
  options.peer.entities = options_.places.size();
  options.peer.overhears = is_station;
  if (is_station && options_.simulated == SimulatedAir::kMedium)
    options.peer.queue.rate = options_.radio.radio.phy.rate;
  options.peer.identities = std::move(identities);
  modems_.push_back(std::make_unique<modem::ModemLink>(options));
  if (auto started = modems_.back()->start(); !started) return started.error();
  return {};
}

// How many modems find how many identities.
std::size_t MixedNetwork::meetings() const {
  const auto apart = static_cast<std::size_t>(std::count_if(
      options_.apart.begin(), options_.apart.end(),
      [this](const auto& pair) { return is_real(pair.first) && is_real(pair.second); }));
  const std::size_t among_real = real_.size() * (real_.size() - 1) - 2 * apart;
  if (simulated_.empty()) return among_real;
  // The station finds each of them, and each of them all behind the station.
  return among_real + real_.size() + real_.size() * simulated_.size();
}

Result<void> MixedNetwork::start(const std::atomic<bool>& stop) {
  if (real_.empty()) return {};
  const auto air = air_->start();
  if (!air) return air.error();
  for (const EntityId each : real_)
    if (auto opened = open(air.value(), {each}); !opened) return opened;
  if (!simulated_.empty())
    if (auto opened = open(air.value(), simulated_); !opened) return opened;
  const Time end = now() + Time::from_seconds(kMeeting);
  for (std::size_t met = 0; met < meetings();) {
    if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
    if (now() > end)
      return Error{ErrorCode::kUnavailable, options_.radio.name,
                   "the modems do not find each other.", ""};
    std::this_thread::sleep_for(kMixedTurn);
    for (const auto& modem : modems_)
      for (const modem::Heard& heard : modem->take(now()))
        met += std::holds_alternative<modem::NeighbourChange>(heard) ? 1 : 0;
  }
  return {};
}

void MixedNetwork::say(EntityId entity, std::size_t bytes) {
  const Message message{entity, kEveryone, number_++, now(),
                        PluginPayload{"", std::vector<std::uint8_t>(bytes)}};
  if (is_real(entity)) {
    const auto at = std::find(real_.begin(), real_.end(), entity) - real_.begin();
    modems_[static_cast<std::size_t>(at)]->send(message.sent, message);
  } else {
    send_to_others(message, options_.places.size(), number_, *medium_);
  }
}

void MixedNetwork::step(std::vector<Arrival>& arrivals) {
  const Time time = now();
  for (std::size_t k = 0; k < modems_.size(); ++k)
    for (const modem::Heard& heard : modems_[k]->take(time)) {
      const auto* message = std::get_if<Message>(&heard);
      if (!message) continue;
      if (k < real_.size())
        arrivals.push_back({message->from, real_[k]});
      else
        send_to_others({message->from, {}, 0, time, message->content},
                       options_.places.size(), number_, *medium_);
    }
  if (medium_) {
    news_.clear();
    medium_->deliver(time, news_);
    for (const MessageOutcome& each : news_.ended) {
      if (each.cause != LossCause::kNone) continue;
      if (!is_real(each.message.to))
        arrivals.push_back({each.message.from, each.message.to});
      else if (!is_real(each.message.from))  // real ones hear each other by themselves
        modems_.back()->send(time, each.message);
    }
  }
  for (const auto& modem : modems_) modem->flush();
  std::this_thread::sleep_for(kMixedTurn);
}

modem::ModemStatistics MixedNetwork::station() const {
  return simulated_.empty() || modems_.empty() ? modem::ModemStatistics{}
                                               : modems_.back()->statistics();
}

}  // namespace skein::mixed_network
