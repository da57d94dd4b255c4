// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/coordinator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>

namespace skein::perimeter::coordinator_test {
namespace {

// Records what it is given, in order: an estimator whose belief is its own history.
class Diary : public PerimeterEstimator {
 public:
  /// @param furthest  the latest time that it or a copy was ever carried on to.
  explicit Diary(std::shared_ptr<Time> furthest = std::make_shared<Time>())
      : furthest_(std::move(furthest)) {}
  void predict(Time time) override {
    EXPECT_GE(time, now_) << "time went back";
    now_ = time;
    *furthest_ = std::max(*furthest_, time);
  }
  void observe(const FireReading& reading) override {
    note(reading.time, reading.inside);
  }
  void observe(const Crossing& crossing) override {
    EXPECT_EQ(crossing.time, now_);
    text_ += "x" + std::to_string(crossing.aircraft.value);
  }
  BoundaryEstimate boundary() const override {
    ++asked_;
    BoundaryEstimate boundary;
    boundary.time = now_;
    BoundaryPoint point;
    point.position = {100, 0};
    point.normal = {1, 0};
    point.rate = 2;
    point.sigma = 5;
    point.sigma_growth = 0.5;
    boundary.rings.push_back({point});
    return boundary;
  }
  EstimatorHealth health() const override {
    return {static_cast<int>(text_.size()), 0, {}};
  }
  std::unique_ptr<PerimeterEstimator> clone() const override {
    return std::make_unique<Diary>(*this);
  }
  const std::string& text() const { return text_; }
  int asked() const { return asked_; }  // for its boundary

 private:
  void note(Time time, bool inside) {
    EXPECT_EQ(time, now_);
    text_ += inside ? "i" : "o";
  }
  std::shared_ptr<Time> furthest_;
  Time now_ = Time::from_ns(-1);
  std::string text_;
  mutable int asked_ = 0;
};

FireReading reading(double t, std::uint32_t aircraft, bool inside) {
  FireReading r;
  r.time = Time::from_seconds(t);
  r.aircraft = EntityId{aircraft};
  r.point = {10 * t, 0};
  r.inside = inside;
  return r;
}

HeardReading heard(double t, std::uint32_t aircraft, bool inside,
                   Follows follows = Follows::kByTime) {
  return {reading(t, aircraft, inside), follows};
}

TEST(CrossingDetector, FindsTheFlipBetweenTwoReadings) {
  CrossingDetector detector;
  EXPECT_FALSE(detector.take(heard(1, 0, false)));
  EXPECT_FALSE(detector.take(heard(1.5, 1, true)));  // another aircraft
  const auto crossing = detector.take(heard(2, 0, true));
  ASSERT_TRUE(crossing);
  EXPECT_TRUE(crossing->entered);
  EXPECT_NEAR(crossing->point.x(), 15, 1e-12);
  EXPECT_NEAR(crossing->track.x(), 10, 1e-12);
  EXPECT_FALSE(detector.take(heard(9, 0, false))) << "too long ago to be a crossing";
}

TEST(CrossingDetector, PairsTheReadingsOfASlowSensor) {
  CrossingDetector detector;
  EXPECT_FALSE(detector.take(heard(5, 0, false)));
  EXPECT_TRUE(detector.take(heard(10, 0, true)));
  EXPECT_FALSE(detector.take(heard(25, 0, false))) << "two readings were lost";
  EXPECT_TRUE(detector.take(heard(30, 0, true)));
}

// Where the air has no room for all, the two that differ come together, or not at all.
TEST(CrossingDetector, PairsNothingAcrossReadingsThatWereNotSent) {
  CrossingDetector detector;
  EXPECT_FALSE(detector.take(heard(0, 0, false, Follows::kPerhaps)));
  EXPECT_FALSE(detector.take(heard(10, 0, false, Follows::kPerhaps)));
  EXPECT_FALSE(detector.take(heard(20, 0, true, Follows::kPerhaps)))
      << "ten seconds, as always, but not one after the other";
  EXPECT_FALSE(detector.take(heard(30, 0, true, Follows::kPerhaps)));
  EXPECT_FALSE(detector.take(heard(31, 0, false, Follows::kNothing)));
  EXPECT_TRUE(detector.take(heard(31, 0, false, Follows::kDirectly)));
  // Those of a slow sensor that were sent together.
  EXPECT_FALSE(detector.take(heard(60, 1, false, Follows::kPerhaps)));
  EXPECT_TRUE(detector.take(heard(75, 1, true, Follows::kDirectly)));
}

TEST(Belief, LateReadingsGiveTheSameAsPunctualOnes) {
  std::vector<HeardReading> all;
  for (unsigned t = 0; t < 50; ++t)
    for (unsigned a : {0u, 1u}) all.push_back(heard(t, a, (t / 7 + a) % 2 == 0));
  auto punctual_diary = std::make_unique<Diary>();
  Diary* punctual_view = punctual_diary.get();
  Belief punctual(std::move(punctual_diary), 60);
  std::size_t crossings = 0;
  for (const auto& r : all) crossings += punctual.take({r}).size();
  const std::string expected = punctual_view->text();

  // Aircraft 1 is received 12 s late, in bunches.
  Belief late(std::make_unique<Diary>(), 60);
  std::size_t late_crossings = 0;
  for (int t = 0; t < 62; ++t) {
    std::vector<HeardReading> batch;
    for (const auto& r : all) {
      const double delay =
          r.reading.aircraft.value == 1 ? 12 - std::fmod(r.reading.time.seconds(), 3) : 0;
      const double arrival = r.reading.time.seconds() + delay;
      if (arrival >= t && arrival < t + 1) batch.push_back(r);
    }
    late_crossings += late.take(batch).size();
  }
  EXPECT_EQ(late.health().observations, static_cast<int>(expected.size()));
  EXPECT_EQ(late_crossings, crossings);
  EXPECT_EQ(late.dropped(), 0);
  EXPECT_EQ(late.time(), punctual.time());
}

TEST(Belief, DropsWhatIsOlderThanItsWindow) {
  Belief belief(std::make_unique<Diary>(), 20);
  for (int t = 0; t < 100; ++t) belief.take({heard(t, 0, false)});
  belief.take({heard(10.5, 1, true)});
  EXPECT_EQ(belief.dropped(), 1);
}

TEST(Belief, MovesTheBoundaryOnWithItsRate) {
  Belief belief(std::make_unique<Diary>(), 60);
  belief.take({heard(10, 0, false)});
  const BoundaryEstimate boundary = belief.boundary_at(Time::from_seconds(13));
  EXPECT_NEAR(boundary.rings[0][0].position.x(), 106, 1e-9);
  EXPECT_NEAR(boundary.rings[0][0].sigma, 6.5, 1e-9);
}

TEST(Belief, AsksForTheBoundaryAgainOnlyAfterNews) {
  auto diary = std::make_unique<Diary>();
  const Diary* view = diary.get();
  Belief belief(std::move(diary), 60);
  belief.take({heard(10, 0, false)});
  for (const double t : {10.0, 10.5, 11.0}) {
    const BoundaryEstimate boundary = belief.boundary_at(Time::from_seconds(t));
    EXPECT_NEAR(boundary.rings[0][0].position.x(), 100 + 2 * (t - 10), 1e-9);
  }
  EXPECT_EQ(view->asked(), 1);
  belief.take({heard(11, 0, false)});
  EXPECT_NEAR(belief.boundary_at(Time::from_seconds(11)).rings[0][0].position.x(), 100,
              1e-9);
  belief.predict(Time::from_seconds(12));
  EXPECT_NEAR(belief.boundary_at(Time::from_seconds(12)).rings[0][0].position.x(), 100,
              1e-9);
  EXPECT_EQ(view->asked(), 3);
}

// Orders every aircraft to one place, each time it is asked.
class Herd : public MonitoringStrategy {
 public:
  std::vector<Assignment> assign(const MonitoringSituation& situation) override {
    std::vector<Assignment> assignments;
    for (const AircraftStatus& aircraft : situation.aircraft)
      if (aircraft.task.number < 2) assignments.push_back({aircraft.id, FlyTo{{1, 2}}});
    return assignments;
  }
};

struct Station {
  explicit Station(const CoordinatorOptions& options)
      : coordinator(options, std::make_unique<Diary>(furthest),
                    std::make_unique<Herd>()) {}

  AgentOutput step(double t, std::vector<Message> inbox) {
    AgentInput in;
    in.now = Time::from_seconds(t);
    in.inbox = inbox;
    AgentOutput out;
    coordinator.step(in, out);
    return out;
  }
  std::shared_ptr<Time> furthest = std::make_shared<Time>();  // of the belief
  Coordinator coordinator;
};

Message report(std::uint32_t from, double t, std::uint32_t task) {
  Message message;
  message.from = EntityId{from};
  AircraftReport content;
  content.nav.time = Time::from_seconds(t);
  content.nav.p_N = {0, 900, -100};
  content.limits = FlightLimits();
  content.task_number = task;
  message.content = content;
  return message;
}

Message read(std::uint32_t from, double t, bool inside) {
  Message message;
  message.from = EntityId{from};
  message.content = reading(t, from, inside);
  return message;
}

std::vector<Task> tasks_for(const AgentOutput& out, std::uint32_t to) {
  std::vector<Task> tasks;
  for (const Message& message : out.outbox)
    if (message.to == EntityId{to})
      if (const auto* task = std::get_if<Task>(&message.content)) tasks.push_back(*task);
  return tasks;
}

bool has_event(const AgentOutput& out, EventKind kind) {
  return std::any_of(out.events.begin(), out.events.end(),
                     [&](const Event& event) { return event.kind == kind; });
}

TEST(Coordinator, DeploysOnATransectThenAllocatesAtTheFirstCrossing) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  Station station(options);
  auto tasks = tasks_for(station.step(0, {report(1, 0, 0)}), 1);
  ASSERT_EQ(tasks.size(), 1u);
  // It is 900 m east of the origin: its transect leads west.
  EXPECT_NEAR(std::abs(std::get<FlyCourse>(tasks[0].what).course), geo::kPi / 2, 1e-9);
  station.step(1, {report(1, 1, 1), read(1, 1, false)});
  const AgentOutput out = station.step(2, {report(1, 2, 1), read(1, 2, true)});
  EXPECT_TRUE(has_event(out, EventKind::kCrossing));
  EXPECT_TRUE(has_event(out, EventKind::kAllocation));
  tasks = tasks_for(out, 1);
  ASSERT_EQ(tasks.size(), 1u);
  EXPECT_EQ(tasks[0].number, 2u);
  EXPECT_TRUE(std::holds_alternative<FlyTo>(tasks[0].what));
}

// The diary believes in a boundary about 100 m from the origin; sigma is 5 m.
TEST(Coordinator, EndsATransectThatHasMissedAllThatIsBelieved) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  options.deployment_limit = 600;
  Station station(options);
  const auto at = [](double t, double east) {
    Message message = report(1, t, 1);
    std::get<AircraftReport>(message.content).nav.p_N = {0, east, -100};
    return message;
  };
  station.step(0, {at(0, 900)});
  EXPECT_FALSE(has_event(station.step(1, {at(1, 900)}), EventKind::kNoCrossing))
      << "on its way";
  EXPECT_FALSE(has_event(station.step(2, {at(2, -200)}), EventKind::kNoCrossing))
      << "there may be more than is believed";
  EXPECT_TRUE(has_event(station.step(3, {at(3, -800)}), EventKind::kNoCrossing));
}

TEST(Coordinator, LooksAheadInPartsFromTheFirstAllocationOnceAPeriod) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  options.forecast.horizons = {600, 3600};
  options.forecast.period = Time::from_seconds(300);
  std::vector<std::pair<Time, Time>> made;  // when, and for when
  const auto fly = [&](Station& station) {
    made.clear();
    int most = 0;
    for (int t = 0; t <= 700; ++t) {
      const Time before = *station.furthest;
      const AgentOutput out = station.step(t, {report(1, t, 9), read(1, t, t >= 100)});
      most = std::max(most, static_cast<int>((*station.furthest - before).seconds()));
      for (const AgentRecord& record : out.records)
        if (const auto* forecast = std::get_if<PerimeterForecast>(&record))
          made.emplace_back(forecast->made, forecast->boundary.time);
    }
    return most;
  };
  Station station(options);
  EXPECT_LE(fly(station), 121) << "no step looks far";
  const auto at = [](double t) { return Time::from_seconds(t); };
  const std::vector<std::pair<Time, Time>> expected = {
      {at(100), at(700)}, {at(100), at(3700)}, {at(400), at(1000)}, {at(400), at(4000)}};
  EXPECT_EQ(made, expected);
  // One at a time, and each to its end, however short the period.
  options.forecast.period = Time::from_seconds(5);
  Station hasty(options);
  fly(hasty);
  ASSERT_GE(made.size(), 20u);
  for (std::size_t k = 0; k + 1 < made.size(); k += 2)
    EXPECT_EQ(made[k].first, made[k + 1].first);
  options.forecast.horizons = {};
  Station blind(options);
  fly(blind);
  EXPECT_TRUE(made.empty());
  EXPECT_LE(*blind.furthest, at(700));
}

TEST(Coordinator, SendsAnUnconfirmedOrderAgain) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  Station station(options);
  station.step(0, {report(1, 0, 0)});
  EXPECT_TRUE(tasks_for(station.step(1, {report(1, 1, 0)}), 1).empty());
  const auto again = tasks_for(station.step(4, {report(1, 4, 0)}), 1);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].number, 1u);
  EXPECT_TRUE(tasks_for(station.step(8, {report(1, 8, 1)}), 1).empty());
}

TEST(Coordinator, ForcesACrossingAfterALongTimeWithout) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  options.forced_crossing = 60;
  options.lost_after = 1e9;
  Station station(options);
  station.step(0, {report(1, 0, 0)});
  station.step(1, {read(1, 1, false)});
  station.step(2, {read(1, 2, true), report(1, 2, 1)});
  const AgentOutput out = station.step(63, {report(1, 63, 2)});
  EXPECT_TRUE(has_event(out, EventKind::kForcedCrossing));
  const auto tasks = tasks_for(out, 1);
  ASSERT_EQ(tasks.size(), 1u);
  // It read "inside" last: a sure crossing is outwards, beyond the boundary.
  EXPECT_GT(std::get<FlyTo>(tasks[0].what).point.x(), 200);
}

TEST(Coordinator, NoticesASilentAircraftAndItsReturn) {
  CoordinatorOptions options;
  options.team = {EntityId{1}, EntityId{2}};
  Station station(options);
  station.step(0, {report(1, 0, 0), report(2, 0, 0)});
  const AgentOutput out = station.step(6, {report(1, 6, 1)});
  ASSERT_TRUE(has_event(out, EventKind::kSilent));
  EXPECT_EQ(out.events[0].entity, EntityId{2});
  EXPECT_FALSE(
      has_event(station.step(7, {report(1, 7, 1), report(2, 7, 1)}), EventKind::kSilent));
}

TEST(Coordinator, ALinkThatIsSlowDoesNotSendTheBeliefBackAndForth) {
  CoordinatorOptions options;
  options.team = {EntityId{1}};
  Station station(options);
  const auto at = [](double t) { return Time::from_seconds(t); };
  for (int t = 8; t < 60; ++t) station.step(t, {report(1, t, 0), read(1, t - 8, false)});
  EXPECT_EQ(*station.furthest, at(51)) << "not beyond the newest reading";
  for (int t = 60; t < 80; ++t) station.step(t, {report(1, t, 0)});
  EXPECT_EQ(*station.furthest, at(79)) << "nothing comes any more: carried on";
}

// A zone around the boundary's only point, sent as the station's zone server sends it.
Message zone_around(const Vec2& place, double floor, double from = 0) {
  ZoneChange change{1, true, {.area = Disc{place, 400}, .name = "a"}};
  change.zone.floor_msl = floor;
  change.zone.from = from;
  Message message;
  message.content = change;
  return message;
}

TEST(Coordinator, SendsNobodyAcrossTheBoundaryIntoAZone) {
  // The path to a sure crossing leads to 315 m north; the aircraft fly at 100 m.
  for (const auto& [floor, from, forced] : {std::tuple{-10.0, 0.0, false},
                                            {149.0, 0.0, false},
                                            {151.0, 0.0, true},
                                            {-10.0, 122.0, false},
                                            {-10.0, 124.0, true}}) {
    CoordinatorOptions options;
    options.team = {EntityId{1}};
    options.forced_crossing = 60;
    options.lost_after = 1e9;
    Station station(options);
    station.step(0, {report(1, 0, 0)});
    station.step(1, {read(1, 1, false), zone_around({300, 0}, floor, from)});
    station.step(2, {read(1, 2, true), report(1, 2, 1)});
    const AgentOutput out = station.step(63, {report(1, 63, 2)});
    EXPECT_EQ(has_event(out, EventKind::kForcedCrossing), forced) << floor << " " << from;
  }
}

}  // namespace
}  // namespace skein::perimeter::coordinator_test
