// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/traffic_beliefs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "skein/layer/reasoning/belief/beliefs.h"

namespace skein::reasoning::traffic_beliefs_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// The own aircraft circles; samples reach its agent every half second.
NavEstimate own_at(double t) {
  NavEstimate nav;
  const double turn = 0.1 * t;
  nav.time = s(t);
  nav.p_N << 200 * geo::unit(turn), -150;
  nav.v_N << 20 * geo::unit(turn + geo::kPi / 2), 0;
  nav.heading = geo::wrap_pi(turn + geo::kPi / 2);
  nav.position_sd = 1;
  return nav;
}

struct Listener {
  Beliefs beliefs{EntityId{0}};
  std::vector<TrafficBelief> records;

  void step(double t, const std::vector<SensorSample>& samples,
            const std::vector<Message>& inbox = {}) {
    const NavEstimate nav = own_at(t);
    AgentInput in;
    in.now = s(t);
    in.nav = &nav;
    in.samples = samples;
    in.inbox = inbox;
    AgentOutput out;
    beliefs.step(in, out);
    for (const AgentRecord& each : out.records)
      if (const auto* belief = std::get_if<TrafficBelief>(&each))
        records.push_back(*belief);
  }
  std::span<const TrafficTrack> tracks() const { return beliefs.traffic().tracks(); }
};

TrafficBroadcast broadcast(double t, std::uint32_t address, const Vec3& p_N,
                           const Vec3& v_N = {20, 0, 0}) {
  TrafficBroadcast heard{s(t), address};
  heard.p_N = p_N;
  heard.v_N = v_N;
  heard.position_sd = 15;
  heard.altitude_sd = 8;
  heard.velocity_sd = 0.7;
  return heard;
}

// What a radar without errors says at a time: seen from the nose of then.
RadarPlot plot(double t, const Vec3& p_N) {
  const NavEstimate own = own_at(t);
  const Vec3 away = p_N - own.p_N;
  RadarPlot found{s(t)};
  found.range = away.norm();
  found.range_sd = 10;
  found.bearing = geo::wrap_pi(geo::bearing(geo::horizontal(away)) - own.heading);
  found.bearing_sd = 0.02;
  found.elevation = math::asin(-away.z() / away.norm());
  found.elevation_sd = 0.02;
  return found;
}

Message report(EntityId from, double t, const Vec3& p_N, const Vec3& v_N) {
  NavEstimate nav;
  nav.time = s(t);
  nav.p_N = p_N;
  nav.v_N = v_N;
  nav.position_sd = 2;
  Message message;
  message.from = from;
  message.content = TeamPosition{from, nav};
  return message;
}

TEST(TrafficBeliefs, PlaceRadarPlotsByWhereTheNoseWasThen) {
  Listener run;
  const Vec3 other(1500, 800, -250);
  // Each plot is 0.7 s old: the nose has turned by 4 degrees since, 100 m at that range.
  for (int k = 0; k < 40; ++k)
    run.step(0.5 * k, k < 2 ? std::vector<SensorSample>()
                            : std::vector<SensorSample>{plot(0.5 * k - 0.7, other)});
  ASSERT_EQ(run.tracks().size(), 1u);
  const TrafficState state = run.tracks()[0].filter.at(s(19.5));
  EXPECT_LT((state.p_N - other).norm(), 12);
  EXPECT_TRUE(is_firm(run.tracks()[0]));
}

TEST(TrafficBeliefs, AreFirmAfterThreeAndRecordedOnceASecond) {
  Listener run;
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.5 * k;
    std::vector<SensorSample> heard;
    if (k % 2 == 0) heard.push_back(broadcast(t, 900, {2000 + 20 * t, 0, -200}));
    run.step(t, heard);
  }
  ASSERT_EQ(run.records.size(), 6u);
  for (std::size_t k = 0; k < run.records.size(); ++k) {
    EXPECT_EQ(run.records[k].firm, k >= 2) << k;
    EXPECT_EQ(run.records[k].address, 900u);
    EXPECT_TRUE(run.records[k].by_broadcast);
    EXPECT_FALSE(run.records[k].by_radar);
  }
  EXPECT_LT((run.records.back().velocity - Vec3(20, 0, 0)).norm(), 0.1);
}

TEST(TrafficBeliefs, CountNobodyOfTheTeamWhateverFindsIt) {
  Listener run;
  const Vec3 v_N(20, 0, 0);
  std::mt19937_64 random{3};
  std::normal_distribution<double> normal;
  const auto member = [&](double t) { return Vec3(500 + 20 * t, 300, -150); };
  for (int k = 1; k < 120; ++k) {
    const double t = 0.5 * k;
    std::vector<SensorSample> found;
    std::vector<Message> inbox;
    if (k % 2 == 0) {
      const Vec3 noise(normal(random), normal(random), normal(random));
      found = {broadcast(t - 0.2, team_address(EntityId{4}), member(t - 0.2) + 15 * noise,
                         v_N),
               plot(t - 0.1, member(t - 0.1))};
      inbox.push_back(report(EntityId{4}, t - 0.4, member(t - 0.4), v_N));
    }
    // For 8 seconds nothing is received of it.
    if (t > 20 && t < 28) inbox.clear();
    run.step(t, found, inbox);
  }
  EXPECT_TRUE(std::ranges::none_of(run.records,
                                   [](const TrafficBelief& each) { return each.firm; }));
}

TEST(TrafficBeliefs, SeeAnIntruderBesideAMemberAndOneWithItsAddress) {
  Listener run;
  const Vec3 v_N(20, 0, 0);
  for (int k = 0; k < 60; ++k) {
    const Vec3 member(500.0 + 20 * k, 300, -150);
    std::vector<SensorSample> heard = {
        // Follows the member at 40 m; of the member itself nothing is heard.
        broadcast(k, 0x900001, member - Vec3(40, 0, 0), v_N),
        // Sends the member's address two kilometres away.
        broadcast(k, team_address(EntityId{4}), member + Vec3(0, 2000, 0), v_N)};
    run.step(k, heard, {report(EntityId{4}, k, member, v_N)});
  }
  int follower = 0, forger = 0;
  for (const TrafficTrack& track : run.tracks()) {
    if (!is_firm(track)) continue;
    follower += track.address == 0x900001u ? 1 : 0;
    forger += track.address == team_address(EntityId{4}) ? 1 : 0;
  }
  EXPECT_EQ(follower, 1);
  EXPECT_EQ(forger, 1);
}

TEST(TrafficBeliefs, SeeAnIntruderInTheSectorOfAMember) {
  // A coarse detector finds both in one direction: one of its two contacts is the
  // member's.
  Listener run;
  for (int k = 0; k < 30; ++k) {
    const NavEstimate own = own_at(k);
    std::vector<SensorSample> heard;
    const Vec3 member(600, 0, -150), intruder(1400, 100, -180);
    for (const Vec3& other : {member, intruder}) {
      const Vec3 away = other - own.p_N;
      TransponderContact contact{s(k)};
      contact.range = geo::horizontal(away).norm();
      contact.range_sd = 0.2 * contact.range;
      contact.bearing = geo::bearing(geo::horizontal(away)) - own.heading;
      contact.bearing_sd = geo::radians(20);
      if (k % 3 != 0) contact.height = -away.z();
      contact.height_sd = 60;
      heard.push_back(contact);
    }
    run.step(k, heard, {report(EntityId{4}, k, member, {0, 0.1, 0})});
  }
  ASSERT_EQ(std::ranges::count_if(run.tracks(), is_firm), 1);
  const auto firm = std::ranges::find_if(run.tracks(), is_firm);
  EXPECT_LT((firm->filter.at(s(29)).p_N - Vec3(1400, 100, -180)).norm(), 300);
}

TEST(TrafficBeliefs, LeaveOutWhatIsNoNumberAndAnOldReport) {
  Listener run;
  TrafficBroadcast broken = broadcast(1, 5, {NAN, 0, 0});
  RadarPlot none{s(1)};  // no deviations
  run.step(1, {broken, none});
  EXPECT_TRUE(run.tracks().empty());
  // A report of 11 s ago explains nothing.
  run.step(12, {plot(12, {900, 0, -200})},
           {report(EntityId{4}, 0.5, {900, 0, -200}, {0, 0, 0})});
  EXPECT_EQ(run.tracks().size(), 1u);
}

}  // namespace
}  // namespace skein::reasoning::traffic_beliefs_test
