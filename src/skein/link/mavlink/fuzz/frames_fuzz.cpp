// SPDX-License-Identifier: Apache-2.0
// Any bytes, cut anywhere: the parser does not fail, and what it finds can be judged,
// read, written again and recorded.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "skein/base/check.h"
#include "skein/link/mavlink/crc.h"
#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/sequence_watch.h"
#include "skein/link/mavlink/signing.h"
#include "skein/link/mavlink/tlog.h"
#include "skein/link/mavlink/unsigned_frames.h"

namespace {

using namespace skein::mavlink;

// What is read is written, and read again, the same: of kinds with all sorts of fields.
// (All kinds are compared with another implementation: tools/interop. Here they would
// cost the compiler a minute and a half.)
void read_and_write(const Frame& frame) {
  dispatch<Heartbeat, SysStatus, ParamSet, GpsRawInt, RawImu, ServoOutputRaw,
           GlobalPositionInt, MissionItemInt, CommandLong, SetPositionTargetLocalNed,
           AutopilotVersion, FileTransferProtocol, HilActuatorControls, BatteryStatus,
           Statustext, SetupSigning>(frame, [&]<Message T>(const T& message) {
    FrameWriter writer(frame.system(), frame.component());
    FrameParser parser;
    int found = 0;
    parser.read(writer.write(message), [&](const Frame& again) {
      ++found;
      SKEIN_CHECK(pack(unpack<T>(again.payload())) == pack(message));
    });
    SKEIN_CHECK(found == 1);
  });
}

// A record's form of a frame: the same without a signature.
void strip(const Frame& frame) {
  // What is not known may always be an order.
  SKEIN_CHECK(frame.message != nullptr || !changes_nothing(frame));
  if (frame.message == nullptr) return;
  const std::vector<std::byte> bytes = without_signature(frame);
  FrameParser parser;
  int found = 0;
  parser.read(bytes, [&](const Frame& again) {
    ++found;
    SKEIN_CHECK(!again.is_signed() && again.id() == frame.id());
    SKEIN_CHECK(std::ranges::equal(again.payload(), frame.payload()));
  });
  SKEIN_CHECK(found == 1);
}

// A fuzzer hardly finds CRCs and signatures: those of frames that are whole are put in.
void put_in_crcs(std::span<std::byte> bytes, const SigningKey& key) {
  Signer signer(key, 0, 0);
  for (std::size_t at = 0; at + kHeader2 < bytes.size(); ++at) {
    const Frame header{bytes.subspan(at)};
    if (header.at(0) != kMagic1 && header.at(0) != kMagic2) continue;
    const MessageEntry* message = find_message(header.id());
    const std::size_t end =
        (header.version() == 1 ? kHeader1 : kHeader2) + std::size_t{header.at(1)};
    const std::size_t length =
        end + kCrcLength + (header.is_signed() ? kSignatureLength : 0);
    if (message == nullptr || at + length > bytes.size()) continue;
    Crc crc;
    crc.add(header.bytes.subspan(1, end - 1));
    crc.add(message->crc_extra);
    bytes[at + end] = static_cast<std::byte>(crc.value() & 0xff);
    bytes[at + end + 1] = static_cast<std::byte>(crc.value() >> 8);
    if (header.is_signed())
      std::ranges::copy(
          signer.sign(header.bytes.first(end + kCrcLength), 0),
          bytes.begin() + static_cast<std::ptrdiff_t>(at + end + kCrcLength));
    at += length - 1;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto given = std::as_bytes(std::span(data, size)).subspan(1);
  std::vector<std::byte> bytes(given.begin(), given.end());
  const SigningKey key = key_of("fuzz");
  if (data[0] >= 64) put_in_crcs(bytes, key);
  FrameParser parser;
  SignatureChecker checker(key);
  SequenceWatch watch;
  const std::size_t piece = data[0] % 64 + 1U;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    parser.read(std::span(bytes).subspan(at, std::min(piece, bytes.size() - at)),
                [&](const Frame& frame) {
                  std::ignore = frame.target_system() + frame.target_component();
                  SKEIN_CHECK(checker.check(frame, 0) != SignatureVerdict::kTooMany);
                  watch.hear(frame);
                  read_and_write(frame);
                  strip(frame);
                });
  const ParserCounts& counts = parser.counts();
  SKEIN_CHECK(counts.skipped_bytes <= bytes.size() && counts.unknown <= counts.frames);
  SKEIN_CHECK(watch.heard() <= counts.frames && watch.loss() >= 0 && watch.loss() <= 1);
  return 0;
}
