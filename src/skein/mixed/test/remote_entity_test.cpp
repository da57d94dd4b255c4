// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/remote_entity.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "skein/geo/polygon.h"

namespace skein::mixed::remote_entity_test {
namespace {

struct Flat final : Terrain {
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};
struct Calm final : WindField {
  Vec3 wind(const Vec3&, Time) const override { return Vec3::Zero(); }
};

// Says where it is each time it is asked.
struct Probe final : Sensor {
  bool payload() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(FireSample{view.now, view.vehicle.p_N.x(), true});
  }
};

struct Desk {
  std::vector<VehicleReport> waiting;
  std::vector<EntityInput> sent;
};

struct DeskPort final : EntityPort {
  explicit DeskPort(Desk& desk) : to(desk) {}
  void receive(Time, std::vector<VehicleReport>& out) override {
    out.insert(out.end(), to.waiting.begin(), to.waiting.end());
    to.waiting.clear();
  }
  void send(Time, EntityInput input) override { to.sent.push_back(std::move(input)); }
  Desk& to;
};

Time seconds(double s) {
  return Time::from_seconds(s);
}

RemoteState flying_north(Time time) {
  RemoteState state;
  state.nav.time = time;
  state.nav.p_N = {100, 0, -50};
  state.nav.v_N = {20, 0, 0};
  return state;
}

struct Stand {
  explicit Stand(std::unique_ptr<EntityPort> port = nullptr, bool by_modem = false) {
    RemoteEntityParts parts;
    parts.name = "scout-1";
    parts.self = EntityId{3};
    parts.port = port ? std::move(port) : std::make_unique<DeskPort>(desk);
    parts.payload.push_back(std::make_unique<Probe>());
    parts.by_modem = by_modem;
    vehicle = std::make_unique<RemoteVehicle>(std::move(parts));
    agent = vehicle->agent();
  }
  // Steps to `now`; what the agent says comes back.
  AgentOutput step(Time now) {
    vehicle->begin_step(now);
    vehicle->take_reports(reports);
    vehicle->take_events(events);
    payload = {};
    vehicle->look(world, now, payload);
    AgentOutput out;
    AgentInput in;
    in.now = now;
    agent->step(in, out);
    vehicle->advance(world, now, now + seconds(0.1), nullptr);
    return out;
  }
  std::vector<EventLabel> kinds() const {
    std::vector<EventLabel> all;
    for (const VehicleEvent& event : events) all.push_back(event.kind);
    return all;
  }

  Desk desk;
  Flat terrain;
  Calm wind;
  Surroundings world{terrain, wind};
  std::unique_ptr<RemoteVehicle> vehicle;
  std::unique_ptr<Agent> agent;
  std::vector<VehicleReport> reports;
  std::vector<VehicleEvent> events;
  PayloadSamples payload;
};

TEST(RemoteVehicle, IsCarriedOnFromItsNewestState) {
  Stand stand;
  EXPECT_FALSE(stand.vehicle->link_works());
  stand.desk.waiting = {LinkChange{LinkChange::Kind::kUp, "x"},
                        EntityReport{flying_north(seconds(10))}};
  stand.step(seconds(10.5));
  EXPECT_TRUE(stand.vehicle->link_works());
  stand.vehicle->begin_step(seconds(11));
  // 20 m/s for a second.
  EXPECT_NEAR(stand.vehicle->estimate().p_N.x(), 120, 1e-9);
  EXPECT_EQ(stand.vehicle->estimate().time, seconds(10)) << "its age is seen";
  EXPECT_EQ(stand.vehicle->truth(), nullptr) << "nobody has said it";
  // An older one changes nothing.
  stand.desk.waiting = {EntityReport{flying_north(seconds(9))}};
  stand.step(seconds(11));
  stand.vehicle->begin_step(seconds(11));
  EXPECT_NEAR(stand.vehicle->estimate().p_N.x(), 120, 1e-9);
}

TEST(RemoteVehicle, KnowsTheTruthOfASimulatedOneWhileItIsYoung) {
  Stand stand;
  RemoteState state = flying_north(seconds(10));
  state.truth.emplace();
  state.truth->p_N = {101, 0, -50};
  state.truth->v_N = {20, 0, 0};
  state.truth->energy.charge = 0.4;
  state.truth_time = seconds(10);
  stand.desk.waiting = {EntityReport{state}};
  stand.vehicle->begin_step(seconds(10.5));
  ASSERT_NE(stand.vehicle->truth(), nullptr);
  EXPECT_NEAR(stand.vehicle->truth()->p_N.x(), 111, 1e-9);
  EXPECT_EQ(stand.vehicle->truth()->energy.charge, 0.4);
  stand.step(seconds(15.1));
  EXPECT_EQ(stand.vehicle->truth(), nullptr);
  stand.step(seconds(16));
  EXPECT_EQ(stand.kinds(), std::vector<EventLabel>{EventKind::kPositionOld});
  EXPECT_TRUE(stand.payload.samples.empty()) << "nobody knows where its sensors are";
  EXPECT_EQ(stand.payload.ends, std::vector<std::size_t>{0});
}

TEST(RemoteVehicle, SendsItsAgentWhatThePayloadSees) {
  Stand stand;
  stand.desk.waiting = {EntityReport{flying_north(seconds(10))}};
  stand.step(seconds(10));
  ASSERT_EQ(stand.payload.samples.size(), 1u);
  ASSERT_EQ(stand.desk.sent.size(), 1u);
  const auto& readings = std::get<PayloadReadings>(stand.desk.sent[0]);
  ASSERT_EQ(readings.samples.size(), 1u);
  EXPECT_EQ(std::get<FireSample>(readings.samples[0]).look_ahead, 100);
}

TEST(RemoteAgent, SaysWhatTheEntitySaysUnderItsOwnName) {
  Stand stand;
  const Event event{seconds(9), EntityId{7}, EventLabel::named("found"), "a person"};
  FireReading reading;
  reading.aircraft = EntityId{8};
  stand.desk.waiting = {
      EntityReport{Message{EntityId{9}, EntityId{0}, 5, {}, Heartbeat{}}},
      EntityReport{event}, EntityReport{reading}};
  const AgentOutput out = stand.step(seconds(10));
  ASSERT_EQ(out.outbox.size(), 1u);
  ASSERT_EQ(out.events.size(), 1u);
  EXPECT_EQ(out.events[0].entity, EntityId{3});
  EXPECT_EQ(out.events[0].time, seconds(9));
  ASSERT_EQ(out.records.size(), 1u);
  EXPECT_EQ(std::get<FireReading>(out.records[0]).aircraft, EntityId{3});
  EXPECT_TRUE(stand.step(seconds(10.1)).outbox.empty()) << "once";
}

TEST(RemoteAgent, HandsOnWhatItIsGiven) {
  Stand stand;
  AgentInput in;
  AgentOutput out;
  const Message order{EntityId{0}, EntityId{3}, 1, seconds(1), Task{4, Hold{}}};
  const Command request = VehicleCommand{"scout-1", ModeRequest{}};
  in.inbox = {&order, 1};
  in.commands = {&request, 1};
  stand.agent->step(in, out);
  stand.vehicle->pilot({});
  EXPECT_TRUE(stand.vehicle->set_fault("motor 1", true, seconds(1)).ok());
  ASSERT_EQ(stand.desk.sent.size(), 4u);
  EXPECT_EQ(std::get<Task>(std::get<Message>(stand.desk.sent[0]).content).number, 4u);
  EXPECT_EQ(kind_of(std::get<Command>(stand.desk.sent[3])), "fault");
}

TEST(RemoteVehicle, ALinkThatIsMadeToFailBringsNothing) {
  Stand stand;
  stand.desk.waiting = {LinkChange{LinkChange::Kind::kUp, ""}};
  stand.step(seconds(1));
  ASSERT_TRUE(stand.vehicle->set_fault("link", true, seconds(1)).ok());
  EXPECT_FALSE(stand.vehicle->link_works());
  stand.desk.waiting = {EntityReport{flying_north(seconds(1))}};
  stand.step(seconds(2));
  EXPECT_EQ(stand.vehicle->estimate().p_N.x(), 0);
  ASSERT_TRUE(stand.vehicle->set_fault("link", false, seconds(2)).ok());
  EXPECT_TRUE(stand.vehicle->link_works());
  stand.step(seconds(3));
  EXPECT_EQ(stand.kinds(),
            (std::vector<EventLabel>{EventKind::kLinkUp, EventKind::kFailure,
                                     EventKind::kRepaired}));
}

TEST(RemoteVehicle, DoesTheSameAgainWithWhatWasRecorded) {
  Stand first;
  std::vector<TimedReport> recorded;
  std::vector<Vec3> places;
  for (int k = 0; k < 50; ++k) {
    const Time now = seconds(0.1 * k);
    if (k == 3) first.desk.waiting = {LinkChange{LinkChange::Kind::kUp, ""}};
    if (k % 7 == 3) first.desk.waiting.emplace_back(EntityReport{flying_north(now)});
    first.reports.clear();
    first.step(now);
    for (const VehicleReport& report : first.reports) recorded.push_back({now, report});
    places.push_back(first.vehicle->estimate().p_N);
  }
  Stand again(std::make_unique<RecordedEntityPort>(recorded));
  for (int k = 0; k < 50; ++k) {
    again.step(seconds(0.1 * k));
    EXPECT_EQ(again.vehicle->estimate().p_N, places[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(again.kinds(), first.kinds());
}

TEST(RemoteEntity, IsReachedByItsModemWhileThatHearsIt) {
  Stand stand(nullptr, true);
  stand.desk.waiting = {LinkChange{LinkChange::Kind::kUp, "here"}};
  stand.step(seconds(0));
  EXPECT_FALSE(stand.vehicle->link_works()) << "its link is not its radio";
  stand.desk.waiting = {OutsideEvent{EventKind::kNeighbourFound, "by the modem"}};
  stand.step(seconds(0.1));
  EXPECT_TRUE(stand.vehicle->link_works());
  stand.desk.waiting = {LinkChange{LinkChange::Kind::kDown, "gone"}};
  stand.step(seconds(0.2));
  EXPECT_TRUE(stand.vehicle->link_works());
  ASSERT_TRUE(stand.vehicle->set_fault("link", true, seconds(0.2)).ok());
  EXPECT_FALSE(stand.vehicle->link_works());
  ASSERT_TRUE(stand.vehicle->set_fault("link", false, seconds(0.2)).ok());
  stand.desk.waiting = {OutsideEvent{EventKind::kNeighbourLost, "by the modem"}};
  stand.step(seconds(0.3));
  EXPECT_FALSE(stand.vehicle->link_works());
  EXPECT_EQ(stand.kinds(),
            (std::vector<EventLabel>{EventKind::kLinkUp, EventKind::kNeighbourFound,
                                     EventKind::kLinkLost, EventKind::kFailure,
                                     EventKind::kRepaired, EventKind::kNeighbourLost}));
}

}  // namespace
}  // namespace skein::mixed::remote_entity_test
