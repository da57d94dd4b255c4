// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/error_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::communication::error_model_test {
namespace {

double ratio_of(double db) {
  return std::pow(10, db / 10);
}

// Of a packet-level simulator with the same error rates: success of 1036 bytes.
TEST(ErrorModels, AreThoseOfDsssAtTwoMegabits) {
  const Dsss2 model;
  struct Case {
    double db, success;
  };
  for (const Case& c :
       {Case{-1, 0.001}, {0, 0.20}, {0.5, 0.50}, {1, 0.76}, {2, 0.97}, {3, 0.998}}) {
    const double success =
        std::exp(model.log_payload_success(ratio_of(c.db), 1036 * 8 / 2e6));
    // The figures are given with two or three digits.
    EXPECT_NEAR(success, c.success, 0.005) << c.db;
  }
}

// Each against its closed formula, for frames of 200 bytes.
TEST(ErrorModels, AreThoseOfTheirFormulas) {
  constexpr double kBits = 1600;
  for (const double db : {-6.0, -4.0, -2.0, 0.0, 3.0, 6.0, 9.0}) {
    const double s = ratio_of(db);
    const double dbpsk = std::pow(1 - 0.5 * std::exp(-22 * s), kBits);
    EXPECT_NEAR(std::exp(Dsss1().log_payload_success(s, kBits / 1e6)), dbpsk, 1e-12);
    EXPECT_NEAR(std::exp(Dsss2().log_header_success(s, 48e-6)),
                std::pow(1 - 0.5 * std::exp(-22 * s), 48), 1e-12);
    const NoncoherentFsk fsk(115'200, 400e3);
    EXPECT_NEAR(std::exp(fsk.log_payload_success(s, kBits / 115'200)),
                std::pow(1 - 0.5 * std::exp(-s * 400e3 / 115'200 / 2), kBits), 1e-12);
    EXPECT_EQ(fsk.log_header_success(s, 1e-3), fsk.log_payload_success(s, 1e-3));
  }
}

// P(e) by another rule than the model's.
double word_error(double e) {
  const double b = std::sqrt(2 * e);
  const auto normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  double right = 0;
  const double step = 1e-4;
  for (double x = -b + step / 2; x < 9; x += step)
    right += std::pow(2 * normal(x + b) - 1, 7) * std::exp(-x * x / 2) /
             std::sqrt(2 * M_PI) * step;
  return 1 - right;
}

TEST(ErrorModels, OfCckAreThoseOfBiorthogonalSignals) {
  EXPECT_NEAR(Cck::word_error(0), 15.0 / 16, 1e-9) << "a guess of 16";
  for (const double e : {0.3, 1.0, 3.0, 8.0, 15.0})
    // Straight lines between the logarithms in a table.
    EXPECT_NEAR(Cck::word_error(e) / word_error(e), 1, 3e-4) << e;
  // At high ratios nearly the union bound: each of 14 neighbours is taken with
  // Q(sqrt(e)).
  for (const double e : {20.0, 30.0}) {
    const double bound = 7 * std::erfc(std::sqrt(e / 2));
    EXPECT_LT(Cck::word_error(e), bound);
    EXPECT_GT(Cck::word_error(e), 0.95 * bound);
  }
  const Cck half(Cck::Bits::kFour), full(Cck::Bits::kEight);
  constexpr double kSecond = 1036 * 8 / 11e6;
  for (const double s : {0.5, 1.5, 4.0}) {
    EXPECT_NEAR(half.log_payload_success(s, 1e-4), 137.5 * std::log1p(-word_error(8 * s)),
                1e-3 * -half.log_payload_success(s, 1e-4));
    EXPECT_NEAR(full.log_payload_success(s, 1e-4), 275 * std::log1p(-word_error(4 * s)),
                1e-3 * -full.log_payload_success(s, 1e-4));
    EXPECT_LT(full.log_payload_success(s, kSecond), half.log_payload_success(s, kSecond));
  }
  EXPECT_EQ(half.log_header_success(0.3, 48e-6), Dsss1().log_header_success(0.3, 48e-6));
}

TEST(ErrorModels, OfPartsMakeThoseOfTheWhole) {
  const Dsss2 model;
  const double whole = model.log_payload_success(1.2, 4e-3);
  const double parts =
      model.log_payload_success(1.2, 1e-3) + model.log_payload_success(1.2, 3e-3);
  EXPECT_NEAR(whole, parts, 1e-12 * std::abs(whole));
  EXPECT_EQ(model.log_payload_success(1.2, 0), 0);
}

TEST(ErrorModels, FallWithTheRatio) {
  const Dsss2 model;
  double payload = -1000, header = -1000;
  for (double db = -20; db < 15; db += 0.5) {
    const double ratio = ratio_of(db);
    EXPECT_GE(model.log_payload_success(ratio, 4e-3), payload);
    EXPECT_GE(model.log_header_success(ratio, 48e-6), header);
    payload = model.log_payload_success(ratio, 4e-3);
    header = model.log_header_success(ratio, 48e-6);
  }
  EXPECT_EQ(payload, 0);
  EXPECT_LT(model.log_payload_success(0, 4e-3), -600);
}

TEST(ErrorModels, WithAThresholdAreAllOrNothing) {
  const ThresholdErrors model(4);
  EXPECT_EQ(model.log_payload_success(4, 1e-3), 0);
  EXPECT_LT(std::exp(model.log_payload_success(3.99, 1e-9)), 1e-100);
}

}  // namespace
}  // namespace skein::communication::error_model_test
