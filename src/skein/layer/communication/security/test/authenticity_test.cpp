// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/security/authenticity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace skein::communication::authenticity_test {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

AuthenticationOptions options(unsigned char key = 7) {
  AuthenticationOptions made;
  made.key.fill(std::byte{key});
  return made;
}

constexpr EntityId kSender{0}, kReceiver{1}, kOther{2};

TEST(Seal, IsWhatAnotherImplementationMakes) {
  // python3: hashlib.blake2b((1).to_bytes(8, "little") + b"fly home", digest_size=16,
  //                          key=bytes(range(32))).hexdigest()
  constexpr std::string_view kWanted = "fda8bfee8103cd70bb227958bfa09f4e";
  TeamKey key;
  for (std::size_t k = 0; k < key.size(); ++k) key[k] = static_cast<std::byte>(k);
  std::vector<std::byte> message = bytes_of("fly home");
  Seal(key).put_on(message, 1);
  ASSERT_EQ(message.size(), 8 + Seal::kBytes);
  std::string found;
  constexpr std::string_view kDigits = "0123456789abcdef";
  for (std::size_t k = message.size() - Seal::kTagBytes; k < message.size(); ++k) {
    const auto byte = std::to_integer<unsigned>(message[k]);
    found += kDigits[byte >> 4];
    found += kDigits[byte & 15U];
  }
  EXPECT_EQ(found, kWanted);
  EXPECT_EQ(Seal(key).counter_of(message), 1u);
}

TEST(Seal, BreaksWithEveryBit) {
  const Seal seal(options().key);
  std::vector<std::byte> message = bytes_of("fly home");
  seal.put_on(message, 0x0123456789ABCDEF);
  EXPECT_EQ(seal.counter_of(message), 0x0123456789ABCDEFu);
  for (std::size_t bit = 0; bit < 8 * message.size(); ++bit) {
    std::vector<std::byte> broken = message;
    broken[bit / 8] ^= static_cast<std::byte>(1U << bit % 8);
    EXPECT_FALSE(seal.counter_of(broken)) << "bit " << bit;
  }
  for (std::size_t size = 0; size < message.size(); ++size)
    EXPECT_FALSE(seal.counter_of(std::span(message).first(size))) << size;
  EXPECT_FALSE(Seal(options(8).key).counter_of(message)) << "another key";
}

TEST(ReplayWindow, AcceptsEachCounterOnceInAnyOrderWithinTheWindow) {
  ReplayWindow window;
  EXPECT_FALSE(window.accept(0));
  for (const std::uint64_t counter : {3u, 1u, 2u, 70u, 7u}) {
    EXPECT_TRUE(window.accept(counter)) << counter;
    EXPECT_FALSE(window.accept(counter)) << counter;
  }
  EXPECT_FALSE(window.accept(6)) << "64 behind";
  EXPECT_TRUE(window.accept(~std::uint64_t{0}));
  EXPECT_FALSE(window.accept(71)) << "long ago";
  EXPECT_TRUE(window.accept(~std::uint64_t{0} - 63));
  EXPECT_FALSE(window.accept(~std::uint64_t{0} - 64));
}

TEST(Authenticity, AcceptsWhatIsSealedOnceFromEachSenderAtEachReceiver) {
  Authenticity team(options(), 3);
  std::vector<std::byte> first = bytes_of("first"), second = bytes_of("second");
  team.seal(kSender, first);
  team.seal(kSender, second);
  EXPECT_EQ(team.judge(kReceiver, kSender, second), Verdict::kAuthentic);
  EXPECT_EQ(team.judge(kReceiver, kSender, first), Verdict::kAuthentic) << "overtaken";
  EXPECT_EQ(team.judge(kReceiver, kSender, first), Verdict::kRepeated);
  EXPECT_EQ(team.judge(kOther, kSender, first), Verdict::kAuthentic);
}

TEST(Authenticity, RefusesAReplayedMessageWhenItsCounterHasLeftTheWindow) {
  Authenticity team(options(), 2);
  std::vector<std::byte> old = bytes_of("old");
  team.seal(kSender, old);
  for (int k = 0; k < 200; ++k) {
    std::vector<std::byte> next = bytes_of("next");
    team.seal(kSender, next);
    EXPECT_EQ(team.judge(kReceiver, kSender, next), Verdict::kAuthentic);
  }
  EXPECT_EQ(team.judge(kReceiver, kSender, old), Verdict::kRepeated);
}

TEST(Authenticity, AForgeryDoesNotUseUpCounters) {
  Authenticity team(options(), 2);
  std::vector<std::byte> forged = bytes_of("fly home");
  for (std::size_t k = 0; k < Seal::kBytes; ++k) forged.push_back(std::byte{0xFF});
  EXPECT_EQ(team.judge(kReceiver, kSender, forged), Verdict::kNoTag);
  std::vector<std::byte> message = bytes_of("stay");
  team.seal(kSender, message);
  EXPECT_EQ(team.judge(kReceiver, kSender, message), Verdict::kAuthentic);
}

TEST(RefusalLog, SpeaksAtOnceAndThenOnceAMinute) {
  RefusalLog log;
  const auto note = [&](double time, EntityId receiver, Verdict verdict) {
    return log.note(Time::from_seconds(time), receiver, kSender, verdict, true,
                    "station");
  };
  const auto first = note(0, kReceiver, Verdict::kNoTag);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->kind, EventKind::kMessageRefused);
  EXPECT_EQ(first->text, "in the name of station: no valid tag");
  for (int k = 1; k < 60; ++k) EXPECT_FALSE(note(k, kReceiver, Verdict::kNoTag));
  EXPECT_TRUE(note(1, kReceiver, Verdict::kRepeated)) << "another reason";
  EXPECT_TRUE(note(1, kOther, Verdict::kNoTag)) << "another receiver";
  const auto again = note(60, kReceiver, Verdict::kNoTag);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->text,
            "in the name of station: no valid tag; 60 since it was last said");
}

}  // namespace
}  // namespace skein::communication::authenticity_test
