// SPDX-License-Identifier: Apache-2.0
// Any packets, one after the other: a session neither fails nor holds more than it says,
// and delivers nothing twice. Values that it delivers are read as both ends read them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/base/check.h"
#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"
#include "skein/data/vehicle/entity_input.h"
#include "skein/data/vehicle/entity_report.h"
#include "skein/link/world_link/session.h"
#include "skein/link/world_link/team_link.h"

namespace {

using namespace skein;

template <class T>
void read_value(std::span<const std::uint8_t> coded, Time shift) {
  auto value = wire::decode<T>(std::as_bytes(coded));
  if (!value || !walk::has_sound_numbers(value.value())) return;
  walk::shift_times(value.value(), shift);
  std::vector<std::byte> again;
  wire::encode(value.value(), again);
  SKEIN_CHECK(wire::decode<T>(again).ok());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  world_link::SessionOptions options;
  options.id = 5;
  world_link::Session session(options);
  world_link::TeamLink team(EntityId{1}, 5);
  Time now;
  while (bytes.size() > 1) {
    const auto length = static_cast<std::size_t>(bytes[0]);
    const auto piece = bytes.subspan(1, std::min(length * 4, bytes.size() - 1));
    bytes = bytes.subspan(1 + piece.size());
    now += Time::from_ns(100'000'000);
    std::vector<Message> messages;
    team.receive(piece, now, messages);
    const auto packet = world_link::decode_packet(piece);
    if (packet)
      session.receive(packet.value(), now, [&](const world_link::Delivery& delivery) {
        read_value<EntitySaying>(delivery.coded, delivery.shift);
        read_value<EntityInput>(delivery.coded, delivery.shift);
      });
    session.step(now, [](const world_link::Packet& out) {
      std::vector<std::byte> coded;
      encode(out, coded);
      SKEIN_CHECK(world_link::decode_packet(coded).ok());
    });
  }
  return 0;
}
