#include "skein/link/modem/gateway.h"

#include <gtest/gtest.h>

namespace skein::modem {
namespace {

constexpr Address kStation{1, 0}, kSimulated{1, 2}, kReal{5, 4};
const Node kBehind{kSimulated, false, kStation};
constexpr EntityId kRealId{4};

TEST(WayOf, StaysHereOrGoesToTheModemOrToTheGateway) {
  EXPECT_EQ(way_of(kBehind, {1, 3}), Way::kLocal);
  EXPECT_EQ(way_of({kStation, true, {}}, kReal), Way::kModem);
  EXPECT_EQ(way_of(kBehind, kReal), Way::kGateway);
  EXPECT_EQ(way_of({kSimulated, false, {}}, kReal), Way::kNone);
  EXPECT_EQ(way_of({kReal, true, {}}, kStation), Way::kModem);
}

TEST(Gateway, FixedShowsOthersAsTheyAre) {
  Gateway gateway(kStation, GatewayMethod::kFixed);
  EXPECT_FALSE(gateway.known_as(kRealId));
  EXPECT_EQ(gateway.pass_on(kReal), kReal);
  EXPECT_EQ(gateway.known_as(kRealId), kReal);
  EXPECT_EQ(gateway.way_out(kBehind, kReal, kRealId), kReal);
  EXPECT_EQ(gateway.way_out({kStation, true, {}}, kReal, kRealId), kReal);
  const Node elsewhere{kSimulated, false, Address{9, 9}};
  EXPECT_FALSE(gateway.way_out(elsewhere, kReal, kRealId)) << "of another gateway";
}

TEST(Gateway, AlteringStandsForOthersAndKnowsTheirTrueAddresses) {
  Gateway gateway(kStation, GatewayMethod::kAltering);
  EXPECT_EQ(gateway.pass_on(kReal), kStation) << "both parts are rewritten";
  EXPECT_EQ(gateway.known_as(kRealId), kStation);
  EXPECT_EQ(way_of(kBehind, kStation), Way::kLocal)
      << "they need no gateway of their own";
  const Node plain{kSimulated, false, {}};
  EXPECT_EQ(gateway.way_out(plain, kStation, kRealId), kReal);
  EXPECT_FALSE(gateway.way_out(plain, {1, 3}, EntityId{3})) << "stays here";
}

TEST(Gateway, ForgetsWhoIsNotHeard) {
  for (const auto method : {GatewayMethod::kFixed, GatewayMethod::kAltering}) {
    Gateway gateway(kStation, method);
    const Address known = gateway.pass_on(kReal);
    gateway.forget(kRealId);
    EXPECT_FALSE(gateway.known_as(kRealId));
    EXPECT_FALSE(gateway.way_out(kBehind, known, kRealId));
  }
}

}  // namespace
}  // namespace skein::modem
