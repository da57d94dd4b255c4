// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/packet.h"

#include "skein/data/describe/wire.h"

namespace skein::world_link {
namespace {

// A year and more: nobody's clock runs for so long, and sums of such times fit.
constexpr std::int64_t kMaxTime = std::int64_t{1} << 55;

bool is_plausible(Time time) {
  return time.ns() > -kMaxTime && time.ns() < kMaxTime;
}

// So is it with counts: the next number is one too.
bool is_count(std::uint64_t number) {
  return number > 0 && number < std::uint64_t{1} << 62;
}

bool is_plausible(const Packet& packet) {
  if (packet.protocol != kProtocol || packet.session == 0 || !is_count(packet.number) ||
      !is_count(packet.oldest) || !is_count(packet.acknowledged) ||
      !is_plausible(packet.sent))
    return false;
  for (const Parcel& parcel : packet.parcels)
    if (!is_count(parcel.number)) return false;
  return !packet.echo ||
         (is_plausible(packet.echo->sent) && is_plausible(packet.echo->held));
}

}  // namespace

void encode(const Packet& packet, std::vector<std::byte>& out) {
  wire::encode(packet, out);
}

Result<Packet> decode_packet(std::span<const std::byte> bytes) {
  auto packet = wire::decode<Packet>(bytes);
  if (packet && !is_plausible(packet.value()))
    return Error{ErrorCode::kBadInput, "", "this is no packet of a world or an agent.",
                 ""};
  return packet;
}

}  // namespace skein::world_link
