// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>
#include <vector>

#include "skein/base/check.h"
#include "skein/base/hash.h"
#include "skein/base/id.h"
#include "skein/base/log.h"
#include "skein/base/random.h"
#include "skein/base/result.h"
#include "skein/base/shown_text.h"
#include "skein/base/time.h"

namespace skein::base_test {
namespace {

TEST(Time, AddsStepsWithoutDrift) {
  Time t;
  const Time step = Time::from_seconds(0.1);
  for (int i = 0; i < 36000; ++i) t += step;
  EXPECT_EQ(t, Time::from_seconds(3600));
  EXPECT_LT(Time::from_seconds(-1e-9), Time());
}

TEST(Check, ReportsConditionAndValues) {
  try {
    SKEIN_CHECK(1 > 2, 42);
    FAIL() << "no Bug thrown";
  } catch (const Bug& bug) {
    EXPECT_NE(std::string(bug.what()).find("1 > 2"), std::string::npos);
    EXPECT_NE(std::string(bug.what()).find("42"), std::string::npos);
  }
}

TEST(Result, HoldsValueOrError) {
  const Result<int> good = 3;
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(good.value(), 3);
  const Result<int> bad = Error{ErrorCode::kNotFound, "a.yaml", "no such file.", ""};
  EXPECT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().text(), "a.yaml: no such file.");
  const auto text = [](const char* message, const char* hint) {
    return Error{ErrorCode::kNotFound, "a", message, hint}.text();
  };
  EXPECT_EQ(text("is wrong.", "Mend it."), "a: is wrong. Mend it.");
  EXPECT_EQ(text("is wrong", "Mend it."), "a: is wrong. Mend it.");
  EXPECT_EQ(text("is wrong", "mend it"), "a: is wrong; mend it");
  EXPECT_THROW(static_cast<void>(bad.value()), Bug);
}

TEST(RandomStream, MatchesThePublishedKnownAnswer) {
  // Philox4x32-10 with zero key and counter: 6627e8d5 e169c58d bc57ac4c 9b00dbd8
  // (Random123 known-answer file).
  RandomStream stream(0, 0, Purpose::kTest);
  EXPECT_EQ(stream.bits(), 0xe169c58d6627e8d5ULL);
  EXPECT_EQ(stream.bits(), 0x9b00dbd8bc57ac4cULL);
}

TEST(RandomStream, IsTheSameFromAnyThread) {
  std::vector<std::uint64_t> here, there;
  RandomStream a(7, 3, Purpose::kGnss), b(7, 3, Purpose::kGnss);
  for (int i = 0; i < 100; ++i) here.push_back(a.bits());
  std::thread([&] {
    for (int i = 0; i < 100; ++i) there.push_back(b.bits());
  }).join();
  EXPECT_EQ(here, there);
}

TEST(RandomStream, SeekContinuesAtThatBlock) {
  RandomStream a(7, 3, Purpose::kGnss), b(7, 3, Purpose::kGnss);
  for (int i = 0; i < 20; ++i) a.bits();
  b.seek(10);
  EXPECT_EQ(a.bits(), b.bits());
}

TEST(RandomStream, InstancesHaveStreamsOfTheirOwn) {
  RandomStream plain(7, 3, Purpose::kGnss), first(7, 3, Purpose::kGnss, 0);
  RandomStream second(7, 3, Purpose::kGnss, 1);
  const std::uint64_t number = plain.bits();
  EXPECT_EQ(first.bits(), number);
  EXPECT_NE(second.bits(), number);
  EXPECT_THROW(RandomStream(7, 3, Purpose::kGnss, 1u << 16), Bug);
}

TEST(RandomStream, NormalsHaveNormalMoments) {
  // 200,000 draws: the standard error of the mean is 0.0022, of the variance 0.0032, of
  // the fourth moment 0.022; each bound is about 4.5 of them.
  RandomStream stream(1, 0, Purpose::kTest);
  const int n = 200000;
  double m1 = 0, m2 = 0, m4 = 0;
  for (int i = 0; i < n; ++i) {
    const double x = stream.normal();
    m1 += x / n;
    m2 += x * x / n;
    m4 += x * x * x * x / n;
  }
  EXPECT_NEAR(m1, 0, 0.01);
  EXPECT_NEAR(m2, 1, 0.015);
  EXPECT_NEAR(m4, 3, 0.1);
}

TEST(RandomStream, StreamsOfNeighboursAreIndependent) {
  // First numbers of 4,096 streams: chi-square over 64 cells has mean 63 and standard
  // deviation 11.2; 130 is six of them above.
  std::vector<int> cells(64);
  for (std::uint32_t entity = 0; entity < 4096; ++entity) {
    RandomStream stream(99, entity, Purpose::kGnss);
    ++cells[static_cast<std::size_t>(stream.uniform() * 64)];
  }
  double chi2 = 0;
  for (const int count : cells) chi2 += (count - 64.0) * (count - 64.0) / 64;
  EXPECT_LT(chi2, 130);
  // Correlation of two streams that differ only in purpose: sd 0.01 for 10,000 pairs.
  RandomStream a(99, 5, Purpose::kGnss), b(99, 5, Purpose::kRadio);
  double product = 0;
  for (int i = 0; i < 10000; ++i) product += a.normal() * b.normal() / 10000;
  EXPECT_NEAR(product, 0, 0.05);
}

TEST(Log, DropsWhatIsBelowItsLevel) {
  const auto written = [](LogLevel level) {
    set_log_level(level);
    testing::internal::CaptureStderr();
    log_debug("rows {}", 1);
    log_info("joined {}", 2);
    log_warning("late {}", 3);
    set_log_level(LogLevel::kWarning);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(written(LogLevel::kDebug),
            "debug: rows 1\ninfo: joined 2\nwarning: late 3\n");
  EXPECT_EQ(written(LogLevel::kInfo), "info: joined 2\nwarning: late 3\n");
  EXPECT_EQ(written(LogLevel::kError), "");
}

TEST(Hasher, DistinguishesOrderAndContent) {
  const auto hash = [](auto... values) {
    Hasher hasher;
    (hasher.add(values), ...);
    return hasher.hex();
  };
  EXPECT_EQ(hash(1.5, 2.5), hash(1.5, 2.5));
  EXPECT_NE(hash(1.5, 2.5), hash(2.5, 1.5));
  EXPECT_EQ(hash(0.0), hash(-0.0));
  EXPECT_NE(hash(std::string_view("ab"), std::string_view("c")),
            hash(std::string_view("a"), std::string_view("bc")));
  EXPECT_EQ(hash(1.0).size(), 32u);
}

TEST(Shown, KeepsWhatSteersATerminalFromIt) {
  // Kept: text of any script, line feeds and tabulators.
  const std::string kept = "Blåfjell 山 é 👩‍🚒\n\tend";
  EXPECT_EQ(shown(kept), kept);
  EXPECT_EQ(shown(""), "");
  EXPECT_EQ(shown("a\x1b[31mb\rc\x7f" + std::string(1, '\0')),
            "a\\x1b[31mb\\x0dc\\x7f\\x00");
  EXPECT_EQ(
      shown("\u0085 \u009b31m \u202e \u2066 \u200f \u061c \ufeff \u2028 \U000e0041"),
      "\\u0085 \\u009b31m \\u202e \\u2066 \\u200f \\u061c \\ufeff \\u2028 \\ue0041");
  EXPECT_EQ(shown("\u00a0\u200d\u202f\u2027"), "\u00a0\u200d\u202f\u2027");
  // No UTF-8: a lone C1 byte, a cut sequence, an overlong form, a surrogate.
  EXPECT_EQ(shown("\x9b"
                  "2J \xe2\x80"),
            "\\x9b2J \\xe2\\x80");
  EXPECT_EQ(shown("\xc0\x9b \xed\xa0\x80"), "\\xc0\\x9b \\xed\\xa0\\x80");
}

TEST(Shown, LeavesNothingThatSteersInAnyBytes) {
  RandomStream random(3, 0, Purpose::kTest);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    for (int k = 0; k < 12; ++k)  // mostly bytes of such characters
      bytes +=
          static_cast<char>("\xc2\xe2\x80\xae\x9b\x1b\xf3\xa0\x81"[random.bits() % 9]);
    const std::string text = shown(bytes);
    EXPECT_EQ(shown(text), text);
    for (const char* hidden : {"\x1b", "\xc2\x9b", "\xe2\x80\xae"})
      EXPECT_EQ(text.find(hidden), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace skein::base_test
