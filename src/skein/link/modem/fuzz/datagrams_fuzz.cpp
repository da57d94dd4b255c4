// SPDX-License-Identifier: Apache-2.0
// Any bytes, as a modem brings them and as a serial line does: neither end fails, nothing
// comes twice, what was read is written and read again, and a good frame is found behind
// whatever came before, once as many bytes have followed as may be missing.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/base/check.h"
#include "skein/link/modem/modem_peer.h"
#include "skein/link/modem/stream_frames.h"

namespace {

using namespace skein;

constexpr std::size_t kGood = 200;

modem::ModemPeerOptions options_of(std::uint32_t hw, bool overhears) {
  modem::ModemPeerOptions options;
  options.hw = hw;
  options.identities = {EntityId{hw - 1}};
  options.entities = 4;
  options.overhears = overhears;
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span<const std::byte> bytes = std::as_bytes(std::span(data, size));
  modem::ModemPeer station(options_of(1, true)), agent(options_of(2, false));
  modem::StreamFrames frames, line;
  std::vector<Message> came;
  Time now;
  const auto take = [&](std::span<const std::byte> datagram) {
    if (const auto read = modem::decode_datagram(datagram)) {
      std::vector<std::byte> again;
      modem::encode(read.value(), again);
      SKEIN_CHECK(modem::decode_datagram(again).ok());
    }
    station.receive(datagram, now, came);
    const std::size_t before = came.size();
    station.receive(datagram, now, came);
    SKEIN_CHECK(came.size() == before);
    agent.receive(datagram, now, came);
    return true;
  };
  bool found = false;
  const auto good = modem::in_frame(bytes.first(std::min(bytes.size(), kGood)));
  const auto look = [&](std::span<const std::byte> datagram) {
    found |= std::ranges::equal(datagram, bytes.first(std::min(bytes.size(), kGood)));
  };
  line.read(bytes, look);
  for (std::size_t sent = 0; !bytes.empty() && sent <= modem::kMaxDatagram + 100;
       sent += good.size())
    line.read(good, look);
  SKEIN_CHECK(found || bytes.empty());
  while (bytes.size() > 1) {
    const auto length = static_cast<std::size_t>(bytes[0]);
    const auto piece = bytes.subspan(1, std::min(length * 4, bytes.size() - 1));
    bytes = bytes.subspan(1 + piece.size());
    now += Time::from_ns(100'000'000);
    take(piece);
    frames.read(piece, take);
    frames.read(modem::in_frame(piece), take);
    for (const Message& message : came) agent.send(message, now);
    came.clear();
    agent.step(now, take);
  }
  return 0;
}
