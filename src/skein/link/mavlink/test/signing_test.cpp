// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/signing.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink::signing_test {
namespace {

using enum SignatureVerdict;

constexpr std::uint64_t kNow = 36'000'000'000;

struct Exchange {
  FrameWriter writer{1, 1};
  Signer signer{key_of("right"), 3, 0};
  SignatureChecker checker{key_of("right")};

  std::vector<std::byte> sign(std::uint64_t now) {
    const auto frame = writer.write(Heartbeat(), signer, now);
    return {frame.begin(), frame.end()};
  }
  SignatureVerdict check(const std::vector<std::byte>& bytes, std::uint64_t now) {
    SignatureVerdict verdict = kUnsigned;
    FrameParser parser;
    parser.read(bytes, [&](const Frame& frame) { verdict = checker.check(frame, now); });
    EXPECT_EQ(parser.counts().frames, 1U);
    return verdict;
  }
};

TEST(Signing, TellsTheRightKeyFromAnother) {
  Exchange x;
  EXPECT_EQ(x.check(x.sign(kNow), kNow), kValid);
  x.signer = Signer(key_of("wrong"), 3, kNow + 10);
  EXPECT_EQ(x.check(x.sign(kNow), kNow), kWrong);
}

TEST(Signing, RefusesWhatIsRepeated) {
  Exchange x;
  const auto first = x.sign(kNow), second = x.sign(kNow);
  EXPECT_EQ(x.check(second, kNow), kValid);
  EXPECT_EQ(x.check(first, kNow), kRepeated);
  EXPECT_EQ(x.check(second, kNow), kRepeated);
}

TEST(Signing, RefusesAStreamThatBeginsMoreThanAMinuteAgo) {
  Exchange x;
  EXPECT_EQ(x.check(x.sign(kNow - 6'000'001), kNow), kOld);
  EXPECT_EQ(x.check(x.sign(kNow - 6'000'000), kNow), kValid);
}

TEST(Signing, AForgedFrameDoesNotChangeItsStream) {
  Exchange x;
  Signer forger(key_of("wrong"), 3, 0);
  FrameWriter writer(1, 1);
  const auto frame = writer.write(Heartbeat(), forger, kNow + 1'000'000'000);
  EXPECT_EQ(x.check({frame.begin(), frame.end()}, kNow), kWrong);
  EXPECT_EQ(x.check(x.sign(kNow), kNow), kValid);
}

TEST(Signing, TimeStampsRiseAlthoughTheClockStands) {
  Signer signer(key_of("right"), 0, 41);
  FrameWriter writer(1, 1);
  writer.write(Heartbeat(), signer, 7);
  EXPECT_EQ(signer.last(), 42U);
  signer.hear(100);
  writer.write(Heartbeat(), signer, 7);
  EXPECT_EQ(signer.last(), 101U);
}

TEST(Signing, CountsFrom2015) {
  EXPECT_EQ(signing_time(std::int64_t{1'420'070'400} * 1'000'000'000), 0U);
  EXPECT_EQ(signing_time(std::int64_t{1'420'070'401} * 1'000'000'000), 100'000U);
  EXPECT_EQ(signing_time(std::int64_t{0}), 0U);
}

}  // namespace
}  // namespace skein::mavlink::signing_test
