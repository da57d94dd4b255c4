// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/datagram.h"

#include <string>

#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"

namespace skein::modem {
namespace {

constexpr std::int64_t kMaxClock = std::int64_t{1} << 55;  // a year [ns]: no overflow

Error no_datagram(std::string why) {
  return {ErrorCode::kBadInput, "datagram", std::move(why), ""};
}

}  // namespace

void encode(const Datagram& datagram, std::vector<std::byte>& out) {
  wire::encode(datagram, out);
}

Result<Datagram> decode_datagram(std::span<const std::byte> bytes) {
  if (bytes.size() > kMaxDatagram) return no_datagram("it is too long.");
  auto read = wire::decode<Datagram>(bytes);
  if (!read) return read.error();
  Datagram& datagram = read.value();
  if (datagram.protocol != kProtocol)
    return no_datagram("it is of another version of the protocol.");
  if (datagram.sent.ns() > kMaxClock || datagram.sent.ns() < -kMaxClock)
    return no_datagram("its time is none.");
  if (!walk::has_sound_numbers(datagram))
    return no_datagram("its numbers make no sense.");
  return read;
}

}  // namespace skein::modem
