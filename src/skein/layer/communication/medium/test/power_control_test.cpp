// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/power_control.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/layer/communication/medium/medium.h"

namespace skein::communication::power_control_test {
namespace {

constexpr double kWaveFactor = 299'792'458 / 2e9 / (4 * geo::kPi);

class Open final : public Propagation {
 public:
  double received(double radiated, const Vec3& from, const Vec3& to) const override {
    return radiated * math::squared(kWaveFactor / (from - to).norm());
  }
};

RadioProfile radio() {
  RadioProfile radio;
  radio.phy.frequency = 2e9;
  radio.phy.transmit_power_dbm = 1;
  radio.phy.decode_threshold_dbm = radio.phy.carrier_sense_threshold_dbm = -81;
  radio.mac.adaptive_power = true;
  return radio;
}

Links::Nodes standing(std::vector<Vec3> places, std::vector<double> power_dbm) {
  Links::Nodes nodes;
  nodes.move = false;
  nodes.transmit_power_dbm = std::move(power_dbm);
  nodes.place = [places = std::move(places)](NodeIndex node, Time) {
    return places[node];
  };
  return nodes;
}

double db(double ratio) {
  return 10 * math::log10(ratio);
}

TEST(PowerControl, SendsWithWhatTheOtherNeeds) {
  const Open field;
  const Links links(radio().phy, field,
                    standing({{0, 0, 0}, {50, 0, 0}, {90, 0, 0}}, {1, 11, 1}));
  PowerControl control(radio(), links);
  EXPECT_EQ(control.share(0, 1), 1);  // never heard
  // -60 dBm of a node's 11 dBm, sent with half of it: -57 with all, -67 with 1 dBm.
  control.heard(0, 1, watts(-60), 0.5);
  EXPECT_NEAR(db(control.share(0, 1)), -75 + 60 - db(2) + 10, 1e-9);  // roundings
  EXPECT_EQ(control.share(0, 2), 1);
  EXPECT_EQ(control.share(1, 0), 1);
  // Much too near: the least power there is.
  control.heard(0, 1, watts(0), 1);
  EXPECT_NEAR(db(control.share(0, 1)), -21, 1e-9);
}

TEST(PowerControl, RaisesItAfterFailuresAndLowersItSlowly) {
  const Open field;
  const Links links(radio().phy, field, standing({{0, 0, 0}, {50, 0, 0}}, {1, 1}));
  PowerControl control(radio(), links);
  control.heard(0, 1, watts(-65), 1);
  EXPECT_NEAR(db(control.share(0, 1)), -10, 1e-9);  // roundings, as below
  control.failed(0, 1);
  EXPECT_NEAR(db(control.share(0, 1)), -7, 1e-9);
  for (int i = 0; i < 10; ++i) control.succeeded(0, 1);
  EXPECT_NEAR(db(control.share(0, 1)), -10, 1e-9);
  for (int i = 0; i < 100; ++i) control.failed(0, 1);
  EXPECT_EQ(control.share(0, 1), 1);
  // Failures at full power raise nothing: less than five steps are to be taken back.
  for (int i = 0; i < 50; ++i) control.succeeded(0, 1);
  EXPECT_NEAR(db(control.share(0, 1)), -10, 1e-9);
}

// Counts what arrives at whom.
class Count final : public MediumListener {
 public:
  void on_frame(const Frame& frame, Time) override {
    lowest = std::min(lowest, frame.power);
  }
  void on_delivered(const Frame&, NodeIndex, Time, const Reception&) override {
    ++delivered;
  }
  void on_finished(const Packet& packet, PacketEnd, Time) override {
    if (medium) medium->send(packet.order);
  }
  Medium* medium = nullptr;
  int delivered = 0;
  double lowest = 1;
};

// Two pairs that always have something to say, 40 m within a pair, 100 m in between:
// all hear all that is sent with full power.
int delivered_by_two_pairs(bool adaptive) {
  const Open field;
  RadioProfile profile = radio();
  profile.phy.transmit_gain_db = profile.phy.receive_gain_db = 1;
  profile.mac.adaptive_power = adaptive;
  Count count;
  Medium medium(profile, field,
                standing({{0, 0, 0}, {40, 0, 0}, {140, 0, 0}, {180, 0, 0}}, {1, 1, 1, 1}),
                3, count);
  count.medium = &medium;
  medium.send({0, 1, 1000, 0});
  medium.send({3, 2, 1000, 0});
  medium.advance(Time::from_seconds(10));
  EXPECT_EQ(count.lowest < 1, adaptive);
  return count.delivered;
}

TEST(Medium, CarriesTwiceAsMuchWhenPairsLowerTheirPower) {
  const int full = delivered_by_two_pairs(false), lowered = delivered_by_two_pairs(true);
  EXPECT_GT(full, 1000);
  // Both pairs send at the same time; what is missing to twice as much are first frames.
  EXPECT_GT(lowered, 1.8 * full);
}

TEST(Medium, LowersNothingThatGoesToAll) {
  const Open field;
  Count count;
  Medium medium(radio(), field, standing({{0, 0, 0}, {20, 0, 0}, {100, 0, 0}}, {1, 1, 1}),
                3, count);
  medium.send({1, 0, 100, 0});
  medium.send({0, kAllNodes, 100, 0});
  medium.advance(Time::from_seconds(1));
  count.lowest = 1;
  medium.send({0, kAllNodes, 100, 0});
  medium.advance(Time::from_seconds(2));
  EXPECT_EQ(count.lowest, 1);
  EXPECT_EQ(count.delivered, 5);
}

}  // namespace
}  // namespace skein::communication::power_control_test
