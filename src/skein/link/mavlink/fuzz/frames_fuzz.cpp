// Any bytes, cut anywhere: the parser neither fails nor depends on the cuts, and what it
// finds can be read and written again.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "skein/base/check.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace {

using namespace skein::mavlink;

template <class T>
void read_and_write(const Frame& frame) {
  if (frame.id() != kFacts<T>.id) return;
  const T message = unpack<T>(frame.payload());
  FrameWriter writer(frame.system(), frame.component());
  FrameParser parser;
  int found = 0;
  parser.read(writer.write(message), [&](const Frame& again) {
    ++found;
    SKEIN_CHECK(pack(unpack<T>(again.payload())) == pack(message));
  });
  SKEIN_CHECK(found == 1);
}

template <class... Ts>
void read_and_write_any(const Frame& frame, const std::tuple<Ts...>*) {
  (read_and_write<Ts>(frame), ...);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span bytes(reinterpret_cast<const std::byte*>(data) + 1, size - 1);
  FrameParser parser;
  SignatureChecker checker(key_of("fuzz"));
  const std::size_t piece = data[0] % 64 + 1U;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    parser.read(bytes.subspan(at, std::min(piece, bytes.size() - at)),
                [&](const Frame& frame) {
                  std::ignore = frame.target_system() + frame.target_component();
                  SKEIN_CHECK(checker.check(frame, 0) != SignatureVerdict::kTooMany);
                  read_and_write_any(frame, static_cast<const AllMessages*>(nullptr));
                });
  const ParserCounts& counts = parser.counts();
  SKEIN_CHECK(counts.skipped_bytes <= bytes.size() && counts.unknown <= counts.frames);
  return 0;
}
