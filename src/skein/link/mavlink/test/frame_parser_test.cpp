// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/frame_parser.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "skein/link/mavlink/crc.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink::frame_parser_test {
namespace {

using Bytes = std::vector<std::byte>;

void append(Bytes& to, std::span<const std::byte> bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <class T>
Bytes frame_of(const T& message, int version = 2) {
  FrameWriter writer(7, 1, version);
  Bytes bytes;
  append(bytes, writer.write(message));
  return bytes;
}

// A frame of version 2 with any payload: what newer definitions send.
Bytes any_frame(std::uint32_t id, std::uint8_t crc_extra, const Bytes& payload,
                std::uint8_t flags = 0) {
  Bytes bytes;
  for (const std::size_t value :
       {std::size_t{kMagic2}, payload.size(), std::size_t{flags}, std::size_t{0},
        std::size_t{3}, std::size_t{7}, std::size_t{1}, std::size_t{id & 0xff},
        std::size_t{id >> 8 & 0xff}, std::size_t{id >> 16}})
    bytes.push_back(static_cast<std::byte>(value));
  append(bytes, payload);
  Crc crc;
  crc.add(std::span(bytes).subspan(1));
  crc.add(crc_extra);
  bytes.push_back(static_cast<std::byte>(crc.value() & 0xff));
  bytes.push_back(static_cast<std::byte>(crc.value() >> 8));
  return bytes;
}

struct Seen {
  std::vector<std::uint32_t> ids;
  std::vector<Bytes> frames;
  void operator()(const Frame& frame) {
    ids.push_back(frame.id());
    frames.emplace_back(frame.bytes.begin(), frame.bytes.end());
  }
};

Attitude attitude() {
  Attitude message;
  message.time_boot_ms = 123456;
  message.roll = 0.1F;
  message.yawspeed = -2.5F;
  return message;
}

TEST(Crc, IsThatOfTheCatalogue) {
  Crc crc;  // check value of CRC-16/MCRF4XX
  for (const char c : std::string("123456789")) crc.add(static_cast<std::uint8_t>(c));
  EXPECT_EQ(crc.value(), 0x6f91);
}

TEST(Payload, KeepsEveryBitOfANumberThatIsNone) {
  CommandLong command;
  command.param4 = std::bit_cast<float>(0x7fc12345U);
  const auto again = unpack<CommandLong>(pack(command));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(again.param4), 0x7fc12345U);
}

TEST(Payload, OfAnOlderSenderIsFilledAndOfANewerOneCut) {
  const Bytes shorter = {std::byte{9}};
  EXPECT_EQ(unpack<MissionAck>(shorter).target_system, 9);
  EXPECT_EQ(unpack<MissionAck>({}).type, 0);
  FrameParser parser;
  Seen seen;
  const Bytes longer(kLength<MissionAck> + 5, std::byte{4});
  parser.read(any_frame(47, kFacts<MissionAck>.crc_extra, longer), seen);
  ASSERT_EQ(seen.ids, std::vector<std::uint32_t>{47});
}

TEST(Payload, TextEndsWithAZeroOnlyWhenItIsShorter) {
  ParamValue value;
  set_text(value.param_id, "SIXTEEN_LETTERS_AND_MORE");
  EXPECT_EQ(text_of(value.param_id), "SIXTEEN_LETTERS_");
  set_text(value.param_id, "SHORT");
  EXPECT_EQ(text_of(value.param_id), "SHORT");
}

TEST(FrameWriter, CutsZerosButForOneByte) {
  EXPECT_EQ(frame_of(Attitude()).size(), kHeader2 + 1 + kCrcLength);
  EXPECT_EQ(frame_of(Attitude(), 1).size(), kHeader1 + kLength<Attitude> + kCrcLength);
}

TEST(FrameWriter, HasNoFrameOfVersion1ForLargeIds) {
  EXPECT_TRUE(frame_of(ObstacleDistance(), 1).empty());
}

RC_GTEST_PROP(FrameParser, FindsTheSameHoweverTheStreamIsCut, ()) {
  // Frames with rubbish between them that holds no false begin.
  Bytes stream;
  std::vector<Bytes> sent;
  FrameWriter writer(7, 1);
  const int frames = *rc::gen::inRange(1, 8);
  for (int k = 0; k < frames; ++k) {
    for (const auto byte : *rc::gen::container<std::vector<std::uint8_t>>(
             rc::gen::inRange<std::uint8_t>(0, 0xfd)))
      stream.push_back(std::byte{byte});
    Attitude message = attitude();
    message.time_boot_ms = *rc::gen::arbitrary<std::uint32_t>();
    const auto frame = writer.write(message);
    sent.emplace_back(frame.begin(), frame.end());
    append(stream, frame);
  }
  FrameParser parser;
  Seen seen;
  for (std::size_t at = 0; at < stream.size();) {
    const auto piece =
        std::min<std::size_t>(*rc::gen::inRange<std::size_t>(1, 70), stream.size() - at);
    parser.read(std::span(stream).subspan(at, piece), seen);
    at += piece;
  }
  RC_ASSERT(seen.frames == sent);
}

TEST(FrameParser, GoesOnOneByteAfterAFalseBegin) {
  // A magic whose "frame" reaches over two real ones.
  Bytes stream = {std::byte{kMagic2}, std::byte{60}, std::byte{0}};
  append(stream, frame_of(attitude()));
  append(stream, frame_of(attitude()));
  append(stream, frame_of(attitude()));
  FrameParser parser;
  Seen seen;
  parser.read(stream, seen);
  EXPECT_EQ(seen.ids.size(), 3U);
  EXPECT_EQ(parser.counts().skipped_bytes, 3U);
}

TEST(FrameParser, CountsAChangedByteAsABadCrc) {
  Bytes stream = frame_of(attitude());
  stream[kHeader2 + 2] ^= std::byte{1};
  append(stream, frame_of(attitude()));
  FrameParser parser;
  Seen seen;
  parser.read(stream, seen);
  EXPECT_EQ(seen.ids.size(), 1U);
  EXPECT_GE(parser.counts().bad_crc, 1U);
}

TEST(FrameParser, HandsOnKindsThatItDoesNotKnow) {
  const Bytes unknown = any_frame(60'000, 17, Bytes(9, std::byte{1}));
  Bytes stream = unknown;
  append(stream, frame_of(attitude()));
  FrameParser parser;
  Seen seen;
  parser.read(stream, seen);
  EXPECT_EQ(seen.ids, (std::vector<std::uint32_t>{60'000, 30}));
  EXPECT_EQ(seen.frames[0], unknown);
  EXPECT_EQ(parser.counts().unknown, 1U);
}

TEST(FrameParser, PassesOverFramesThatNeedMoreThanItKnows) {
  Bytes stream = any_frame(30, kFacts<Attitude>.crc_extra, Bytes(28, std::byte{1}), 0x02);
  append(stream, frame_of(attitude()));
  FrameParser parser;
  Seen seen;
  parser.read(stream, seen);
  EXPECT_EQ(seen.ids.size(), 1U);
  EXPECT_EQ(parser.counts().incompatible, 1U);
  EXPECT_EQ(parser.counts().skipped_bytes, 0U);
}

TEST(FrameParser, ReadsAnEmptyPayload) {  // as one other library sends zeros
  FrameParser parser;
  Seen seen;
  parser.read(any_frame(30, kFacts<Attitude>.crc_extra, {}), seen);
  EXPECT_EQ(seen.ids.size(), 1U);
}

TEST(Frame, SaysForWhomItIs) {
  CommandLong command;
  command.target_system = 42;
  command.target_component = 190;
  FrameParser parser;
  parser.read(frame_of(command), [](const Frame& frame) {
    EXPECT_EQ(frame.target_system(), 42);
    EXPECT_EQ(frame.target_component(), 190);
  });
  parser.read(frame_of(attitude()),
              [](const Frame& frame) { EXPECT_EQ(frame.target_system(), 0); });
  EXPECT_EQ(parser.counts().frames, 2U);
}

}  // namespace
}  // namespace skein::mavlink::frame_parser_test
