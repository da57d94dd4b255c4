// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/datagram.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/data/describe/wire.h"
#include "skein/link/modem/stream_frames.h"

namespace skein::modem::datagram_test {
namespace {

Datagram datagram_of(std::size_t bytes) {
  Datagram datagram;
  datagram.session = 7;
  datagram.origin = {2, 1};
  datagram.to = {1, 0};
  datagram.number = 3;
  datagram.urgency = Urgency::kCommand;
  datagram.sent = Time::from_seconds(12);
  Carried carried;
  carried.message = {EntityId{1}, EntityId{0}, 5, Time::from_seconds(11),
                     PluginPayload{"test", std::vector<std::uint8_t>(bytes, 0x53)}};
  datagram.payload = carried;
  return datagram;
}

std::vector<std::byte> coded(const Datagram& datagram) {
  std::vector<std::byte> bytes;
  encode(datagram, bytes);
  return bytes;
}

TEST(Datagram, IsReadAsItWasWritten) {
  const auto read = decode_datagram(coded(datagram_of(100)));
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(coded(read.value()), coded(datagram_of(100)));
  EXPECT_EQ(read.value().to, (Address{1, 0}));
  EXPECT_EQ(std::get<Carried>(read.value().payload).message.number, 5u);
}

TEST(Datagram, ThatMakesNoSenseIsRefused) {
  Datagram other = datagram_of(10);
  other.protocol = 1;
  EXPECT_FALSE(decode_datagram(coded(other)).ok());
  other = datagram_of(10);
  other.sent = Time::from_ns(std::numeric_limits<std::int64_t>::max());
  EXPECT_FALSE(decode_datagram(coded(other)).ok());
  other = datagram_of(10);
  AircraftReport report;
  report.nav.p_N.x() = std::numeric_limits<double>::quiet_NaN();
  std::get<Carried>(other.payload).message.content = report;
  EXPECT_FALSE(decode_datagram(coded(other)).ok());
  EXPECT_FALSE(decode_datagram(coded(datagram_of(kMaxDatagram))).ok()) << "too long";
  auto bytes = coded(datagram_of(10));
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(decode_datagram(std::span(bytes).first(length)).ok()) << length;
}

TEST(StreamFrames, CheckSequenceIsTheOneOfTheStandard) {
  const std::string_view text = "123456789";
  EXPECT_EQ(check_sequence(std::as_bytes(std::span(text))), 0x29B1)
      << "published check value of CRC-16/CCITT-FALSE";
}

TEST(StreamFrames, AreFoundWhereverTheyAreCut) {
  const auto first = coded(datagram_of(30)), second = coded(datagram_of(900));
  std::vector<std::byte> line = in_frame(first);
  const auto more = in_frame(second);
  line.insert(line.end(), more.begin(), more.end());
  for (std::size_t cut = 1; cut < line.size(); cut += 7) {
    StreamFrames frames;
    std::vector<std::vector<std::byte>> found;
    const auto take = [&](std::span<const std::byte> bytes) {
      found.emplace_back(bytes.begin(), bytes.end());
    };
    for (std::size_t at = 0; at < line.size(); at += cut)
      frames.read(std::span(line).subspan(at, std::min(cut, line.size() - at)), take);
    ASSERT_EQ(found.size(), 2u) << cut;
    EXPECT_EQ(found[0], first);
    EXPECT_EQ(found[1], second);
    EXPECT_EQ(frames.damaged(), 0u);
  }
}

TEST(StreamFrames, GoOnAfterNoiseAndDamage) {
  const auto good = coded(datagram_of(30));
  std::vector<std::byte> line(50, std::byte{'S'});
  auto bad = in_frame(good);
  bad[10] ^= std::byte{4};
  for (const auto& frame : {bad, in_frame(good), in_frame(good)})
    line.insert(line.end(), frame.begin(), frame.end());
  line.erase(line.begin() + 55);  // a byte is missing in the first
  StreamFrames frames;
  std::size_t found = 0;
  frames.read(line, [&](std::span<const std::byte> bytes) {
    ++found;
    EXPECT_EQ(std::vector<std::byte>(bytes.begin(), bytes.end()), good);
  });
  EXPECT_EQ(found, 2u);
}

// Whatever the damage says, the very next frame is found.
TEST(StreamFrames, DoNotWaitForADamagedLength) {
  const auto good = coded(datagram_of(30));
  for (const std::size_t at : {2u, 3u, 4u, 5u})
    for (int bit = 0; bit < 8; ++bit) {
      auto bad = in_frame(good);
      bad[at] ^= std::byte{1} << bit;
      StreamFrames frames;
      std::size_t found = 0;
      const auto count = [&](std::span<const std::byte>) { ++found; };
      frames.read(bad, count);
      EXPECT_EQ(found, 0u) << at << " " << bit;
      EXPECT_GE(frames.damaged(), 1u);
      frames.read(in_frame(good), count);
      EXPECT_EQ(found, 1u) << at << " " << bit;
    }
}

TEST(StreamFrames, FindTheNextOneWhenAsManyBytesHaveComeAsAreMissing) {
  const auto good = coded(datagram_of(30));
  auto cut = in_frame(good);
  cut.erase(cut.begin() + 20, cut.begin() + 30);
  StreamFrames frames;
  std::size_t found = 0;
  const auto count = [&](std::span<const std::byte>) { ++found; };
  frames.read(cut, count);
  frames.read(in_frame(good), count);
  EXPECT_EQ(found, 1u);
  EXPECT_EQ(frames.damaged(), 1u);
}

}  // namespace
}  // namespace skein::modem::datagram_test
