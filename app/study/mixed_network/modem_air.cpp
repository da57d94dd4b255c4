// SPDX-License-Identifier: Apache-2.0
#include "app/study/mixed_network/modem_air.h"

#include <utility>

#include "skein/layer/communication/medium_radio.h"
#include "skein/link/modem/datagram.h"

namespace skein::mixed_network {
namespace {

constexpr std::chrono::milliseconds kAirTurn{1};

}  // namespace

std::unique_ptr<Radio> standing_radio(const assemble::RadioFile& radio,
                                      std::vector<Vec3> places, std::uint64_t seed) {
  communication::MediumRadioOptions options;
  options.profile = radio.radio;
  options.spread = 0;
  const std::size_t count = places.size();
  const auto place = [places = std::move(places)](EntityId id) -> std::optional<Vec3> {
    return places.at(id.value);
  };
  return std::make_unique<communication::MediumRadio>(
      options, make_propagation(radio, seed).value(),
      communication::RadioNodes{count, place,
                                [](EntityId id) { return std::to_string(id.value); }},
      seed);
}

void send_to_others(Message message, std::size_t nodes, std::uint64_t& number,
                    Radio& radio) {
  message.copy = false;
  for (std::uint32_t to = 0; to < nodes; ++to) {
    if (to == message.from.value) continue;
    message.to = EntityId{to};
    message.number = number++;
    radio.send(message);
    message.copy = true;
  }
}

ModemAir::ModemAir(const assemble::RadioFile& radio, std::vector<Vec3> places,
                   std::uint64_t seed)
    : channels_(places.size()), endpoints_(*this) {
  medium_ = standing_radio(radio, std::move(places), seed);
}

ModemAir::~ModemAir() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

Time ModemAir::now() const {
  return Time::from_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(
                           std::chrono::steady_clock::now() - begin_)
                           .count());
}

Result<transport::EndpointAddress> ModemAir::start() {
  auto server = transport::parse_endpoint("udpin:0");
  if (!server) return server.error();
  if (auto opened = endpoints_.open(server.value()); !opened) return opened.error();
  const auto place = transport::parse_endpoint(endpoints_.places().at(0));
  if (!place) return place.error();
  thread_ = std::thread([this] { run(); });
  return *transport::counterpart(place.value());
}

void ModemAir::run() {
  RadioNews news;
  while (!stop_) {
    endpoints_.run_for(kAirTurn);
    news.clear();
    medium_->deliver(now(), news);
    for (const MessageOutcome& each : news.ended) {
      const auto channel = channels_[each.message.to.value];
      if (each.cause != LossCause::kNone || !channel) continue;
      const auto& datagram = std::get<PluginPayload>(each.message.content).coded;
      endpoints_.send(*channel, std::as_bytes(std::span(datagram)));
    }
  }
}

void ModemAir::opened(transport::ChannelId, transport::EndpointId, const std::string&) {}

void ModemAir::received(transport::ChannelId channel, std::span<const std::byte> bytes) {
  const auto datagram = modem::decode_datagram(bytes);
  if (!datagram) return;
  const std::uint32_t node = datagram.value().origin.hw - 1;
  if (node >= channels_.size()) return;
  channels_[node] = channel;
  PluginPayload carried{"", {}};
  for (const std::byte each : bytes)
    carried.coded.push_back(std::to_integer<std::uint8_t>(each));
  send_to_others({EntityId{node}, {}, 0, now(), std::move(carried)}, channels_.size(),
                 number_, *medium_);
}

void ModemAir::closed(transport::ChannelId, const std::string&) {}

}  // namespace skein::mixed_network
