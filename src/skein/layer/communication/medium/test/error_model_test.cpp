#include "skein/layer/communication/medium/error_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skein::communication {
namespace {

// Of a packet-level simulator with the same error rates: success of 1036 bytes.
TEST(ErrorRates, AreThoseOfDsssAtTwoMegabits) {
  const ErrorRates rates;
  struct Case {
    double db, success;
  };
  for (const Case& c :
       {Case{-1, 0.001}, {0, 0.20}, {0.5, 0.50}, {1, 0.76}, {2, 0.97}, {3, 0.998}}) {
    const double ratio = std::pow(10, c.db / 10);
    const double success = std::exp(rates.log_payload_success(ratio, 1036 * 8 / 2e6));
    // The figures are given with two or three digits.
    EXPECT_NEAR(success, c.success, 0.005) << c.db;
  }
}

TEST(ErrorRates, OfPartsMakeThoseOfTheWhole) {
  const ErrorRates rates;
  const double whole = rates.log_payload_success(1.2, 4e-3);
  const double parts =
      rates.log_payload_success(1.2, 1e-3) + rates.log_payload_success(1.2, 3e-3);
  EXPECT_NEAR(whole, parts, 1e-12 * std::abs(whole));
  EXPECT_EQ(rates.log_payload_success(1.2, 0), 0);
}

TEST(ErrorRates, FallWithTheRatio) {
  const ErrorRates rates;
  double payload = -1000, header = -1000;
  for (double db = -20; db < 15; db += 0.5) {
    const double ratio = std::pow(10, db / 10);
    EXPECT_GE(rates.log_payload_success(ratio, 4e-3), payload);
    EXPECT_GE(rates.log_header_success(ratio, 48e-6), header);
    payload = rates.log_payload_success(ratio, 4e-3);
    header = rates.log_header_success(ratio, 48e-6);
  }
  EXPECT_EQ(payload, 0);
  EXPECT_LT(rates.log_payload_success(0, 4e-3), -600);
}

TEST(ErrorRates, WithAThresholdAreAllOrNothing) {
  const ErrorRates rates{.model = ErrorModel::kThreshold, .least_ratio = 4};
  EXPECT_EQ(rates.log_payload_success(4, 1e-3), 0);
  EXPECT_LT(std::exp(rates.log_payload_success(3.99, 1e-9)), 1e-100);
}

}  // namespace
}  // namespace skein::communication
