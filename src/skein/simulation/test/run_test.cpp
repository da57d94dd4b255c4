#include "skein/simulation/run.h"

#include "skein/role/agent.h"
#include "skein/role/radio.h"
#include "skein/simulation/commanded_wind.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <new>

#include "skein/simulation/simulated_vehicle.h"

namespace skein::simulation {
namespace {

class Ground : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 0; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

class Calm : public WindField {
 public:
  Vec3 wind(const Vec3&, Time) const override { return Vec3::Zero(); }
};

class NoFire : public Phenomenon {
 public:
  void advance(Time) override {}
  bool inside(const Vec2&) const override { return false; }
  const geo::Region& region() const override { return region_; }

 private:
  geo::Region region_;
};

// Delivers every message `delay` after it was sent.
class Post : public Radio {
 public:
  explicit Post(Time delay) : delay_(delay) {}
  void send(const Message& message) override { mail_.push_back(message); }
  void deliver(Time now, std::vector<Message>& arrived, std::vector<Message>&) override {
    std::erase_if(mail_, [&](const Message& m) {
      if (m.sent + delay_ > now) return false;
      arrived.push_back(m);
      return true;
    });
  }

 private:
  Time delay_;
  std::vector<Message> mail_;
};

// Flies straight on at the commanded climb rate.
class Glider : public Plant {
 public:
  explicit Glider(double break_after = std::numeric_limits<double>::infinity())
      : break_after_(break_after) {}
  FlightLimits limits() const override { return {}; }
  Airframe airframe() const override { return SelfStabilised{}; }
  VehicleState start(const VehicleStart&) const override { return {}; }
  void step(VehicleState& s, const Control& c, const Air&, double dt) const override {
    s.v_N = {20, 0, -std::get<FlightCommand>(c).climb_rate};
    s.p_N += dt * s.v_N;
    if (s.p_N.x() > break_after_) s.p_N.x() = std::nan("");
  }
  Contact touch(VehicleState&, double, double) const override { return Contact::kCrash; }

 private:
  double break_after_;
};

class Hands : public Autopilot {
 public:
  explicit Hands(double climb) : climb_(climb) {}
  void begin(const NavEstimate&, bool) override {}
  void sense(const SensorSample&) override {}
  void command(const AutopilotCommand&) override {}
  void set_return(const ReturnRoute&) override {}
  Control control(Time, double) override { return FlightCommand{0, 20, climb_}; }
  NavEstimate estimate() const override { return estimate_; }
  AutopilotStatus status() const override { return {}; }

 private:
  double climb_;
  NavEstimate estimate_;
};

// Sends one message a step to `to`, and notes what it receives.
class Talker : public Agent {
 public:
  explicit Talker(EntityId to) : to_(to) {}
  void step(const AgentInput& in, AgentOutput& out) override {
    for (const Message& message : in.inbox)
      out.events.push_back(
          {in.now, message.from, "heard", std::to_string(message.number)});
    if (in.now == Time::from_seconds(4)) out.records.emplace_back(Crossing{in.now, to_});
    Message message;
    message.to = to_;
    message.content = AircraftReport{};
    out.outbox.push_back(message);
  }

 private:
  EntityId to_;
};

// Everything as text, in order.
class Notes : public Recorder {
 public:
  void record(const Record& record) override {
    std::visit([this](const auto& one) { note(one); }, record);
  }
  Result<void> step_done(Time now) override {
    if (full_at && now >= *full_at)
      return Error{ErrorCode::kUnavailable, "disk", "it is full.", ""};
    return {};
  }
  std::string text, kinds, objects;
  std::vector<RangeScan> scans;
  std::vector<CommandRecord> commands;
  int truths = 0, messages = 0, crossings = 0;
  std::optional<Time> full_at;

 private:
  template <class Other>
  void note(const Other&) {}
  void note(const EntityRecord& e) { text += fmt::format("{}={};", e.id.value, e.name); }
  void note(const TruthRecord& t) {
    text += fmt::format("T{} {} {};", t.time.ns(), t.id.value, t.state.p_N.x());
    ++truths;
  }
  void note(const MessageRecord& m) {
    text +=
        fmt::format("M{} {} {};", m.arrived.ns(), m.message.from.value, m.message.number);
    ++messages;
  }
  void note(const Event& e) {
    text += fmt::format("E{} {} {} {};", e.time.ns(), e.entity.value, e.kind, e.text);
    if (e.kind != "heard") kinds += e.kind + " ";
  }
  void note(const Crossing& c) {
    text += fmt::format("C{} {};", c.time.ns(), c.aircraft.value);
    ++crossings;
  }
  void note(const GroundObject& o) { objects += o.name + ";"; }
  void note(const RangeScan& scan) { scans.push_back(scan); }
  void note(const CommandRecord& command) { commands.push_back(command); }
};

class Silent : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return asked++ >= stop_after; }
  mutable int asked = 0;
  int stop_after = std::numeric_limits<int>::max();
};

using Change = std::function<void(std::size_t index, VehicleParts& parts)>;

World make_world(int count, Time delay = Time(), double climb = 0,
                 const Change& change = {}) {
  World world;
  world.terrain = std::make_unique<Ground>();
  world.wind = std::make_unique<CommandedWind>(std::make_unique<Calm>());
  world.fire = std::make_unique<NoFire>();
  world.radio = std::make_unique<Post>(delay);
  const auto plant = std::make_shared<Glider>();
  for (int i = 0; i < count; ++i) {
    Entity entity;
    entity.name = fmt::format("a{}", i);
    entity.kind = "aircraft";
    entity.agent =
        std::make_unique<Talker>(EntityId{static_cast<std::uint32_t>((i + 1) % count)});
    entity.agent_period = Time::from_seconds(0.5);
    VehicleParts parts;
    parts.name = entity.name;
    parts.plant = plant;
    parts.autopilot = std::make_unique<Hands>(climb);
    parts.step = Time::from_seconds(0.1);
    parts.state.p_N = {0, 0, -50};
    if (change) change(static_cast<std::size_t>(i), parts);
    entity.vehicle = std::make_unique<SimulatedVehicle>(std::move(parts));
    entity.active = {{Time(), Time::from_seconds(1e6)}};
    world.entities.push_back(std::move(entity));
  }
  return world;
}

RunOptions seconds(double duration, int threads = 1) {
  RunOptions options;
  options.duration = Time::from_seconds(duration);
  options.threads = threads;
  return options;
}

TEST(Run, RecordsAtItsRateAndDeliversMessages) {
  World world = make_world(2);
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kDone);
  EXPECT_EQ(notes.truths, 2 * 101);
  EXPECT_EQ(notes.messages, 2 * 21);
  EXPECT_EQ(notes.crossings, 2) << "each reports one, recorded once";
  EXPECT_NEAR(world.entities[0].vehicle->truth()->p_N.x(), 20 * 10.1, 1e-9);
}

TEST(Run, IsTheSameForAnyNumberOfThreads) {
  std::string first;
  for (const int threads : {1, 2, 4}) {
    World world = make_world(100, Time::from_seconds(0.3));
    Notes notes;
    Silent console;
    ASSERT_TRUE(run(world, seconds(5, threads), notes, console).ok());
    if (first.empty()) first = notes.text;
    EXPECT_EQ(notes.text, first) << threads << " threads";
  }
}

TEST(Run, EntitiesJoinAndLeave) {
  World world = make_world(2);
  world.entities[1].active = {{Time::from_seconds(1), Time::from_seconds(2)},
                              {Time::from_seconds(3), Time::from_seconds(4)}};
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(5), notes, console).ok());
  EXPECT_EQ(notes.kinds, "joined joined left joined left ");
  EXPECT_EQ(notes.truths, 51 + 20);
}

TEST(Run, AnAircraftThatHitsTheGroundEndsAsAnAccident) {
  World world = make_world(2, Time(), -10, [](std::size_t i, VehicleParts& parts) {
    if (i == 0) parts.state.p_N.z() = -1000;
  });
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(10), notes, console).ok());
  EXPECT_NE(notes.text.find("1 accident"), std::string::npos);
  EXPECT_EQ(notes.text.find("0 accident"), std::string::npos);
}

TEST(Run, StopsCleanlyWhenAsked) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  console.stop_after = 30;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 30);
}

TEST(Run, ReportsARecorderThatFails) {
  World world = make_world(1);
  Notes notes;
  notes.full_at = Time::from_seconds(2);
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(outcome.error().text(), "disk: it is full (at 2.000 s of simulated time).");
}

// Says how long ago it last measured, as an inertial unit's interval does.
class Intervals : public Sensor {
 public:
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    ImuSample sample;
    sample.time = view.now;
    sample.interval = (view.now - last_).seconds();
    last_ = view.now;
    out.emplace_back(sample);
  }

 private:
  Time last_;
};

// Notes when its flight began and what it sensed.
class Listener : public Hands {
 public:
  Listener() : Hands(0) {}
  void begin(const NavEstimate& start, bool) override { begun.push_back(start); }
  void sense(const SensorSample& sample) override {
    if (const auto* imu = std::get_if<ImuSample>(&sample))
      longest = std::max(longest, imu->interval), ++heard;
  }
  std::vector<NavEstimate> begun;
  double longest = 0;
  int heard = 0;
};

// Puts a listener, which stays its vehicle's, into the first vehicle.
Change listen(Listener** heard, std::vector<VehicleFault> faults = {}) {
  return [heard, faults](std::size_t, VehicleParts& parts) {
    auto listener = std::make_unique<Listener>();
    *heard = listener.get();
    parts.autopilot = std::move(listener);
    parts.sensors.push_back(std::make_unique<Intervals>());
    parts.faults = faults;
  };
}

TEST(Run, AFlightBeginsWhenTheAircraftJoinsAndAgainWhenItReturns) {
  Listener* listener = nullptr;
  World world = make_world(1, Time(), 0, listen(&listener));
  world.entities[0].active = {{Time::from_seconds(1), Time::from_seconds(2)},
                              {Time::from_seconds(5), Time::from_seconds(6)}};
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(8), notes, console).ok());
  ASSERT_EQ(listener->begun.size(), 2u);
  EXPECT_EQ(listener->begun[0].time, Time::from_seconds(1));
  EXPECT_EQ(listener->begun[1].time, Time::from_seconds(5));
  EXPECT_NEAR(listener->begun[1].p_N.x(), 20 * 1.0, 1e-9) << "where it left";
  EXPECT_LT(listener->longest, 1.01) << "nothing is measured over the time between";
}

TEST(Run, ASensorThatFailsSpeaksOfNowWhenItIsBack) {
  Listener* listener = nullptr;
  World world =
      make_world(1, Time(), 0,
                 listen(&listener, {{VehicleFault::Kind::kSensor, 0,
                                     Time::from_seconds(2), Time::from_seconds(4)}}));
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(8), notes, console).ok());
  EXPECT_NEAR(listener->heard, 82 - 20, 1);
  EXPECT_LT(listener->longest, 0.11) << "not of the whole time of silence";
  EXPECT_EQ(notes.kinds, "joined failure repaired ");
  EXPECT_NE(notes.text.find(" repaired  works again;"), std::string::npos) << notes.text;
}

// Payload that measures a range of its own in every step.
class Beam : public Sensor {
 public:
  explicit Beam(double range) : range_(range) {}
  bool payload() const override { return true; }
  void sample(const SensorView& view, std::vector<SensorSample>& out) override {
    out.emplace_back(RangeSample{view.now, {0, 0, 1}, range_});
  }

 private:
  double range_;
};

TEST(Run, RecordsEachPayloadSampleOnceAndByWhichSensor) {
  World world = make_world(1, Time(), 0, [](std::size_t, VehicleParts& parts) {
    parts.payload.push_back(std::make_unique<Beam>(10));
    parts.payload.push_back(std::make_unique<Beam>(20));
    parts.faults = {
        {VehicleFault::Kind::kPayload, 0, Time::from_seconds(1), Time::from_seconds(2)}};
  });
  world.objects.push_back({4, "car", {1, 2}, {0, 0}});
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(3), notes, console).ok());
  EXPECT_EQ(notes.objects, "car;");
  int first = 0, second = 0;
  Time last = Time::from_ns(-1);
  for (const RangeScan& scan : notes.scans) {
    ASSERT_EQ(scan.beams.size(), 1u);
    EXPECT_EQ(scan.beams[0].range, scan.sensor == 0 ? 10 : 20);
    EXPECT_EQ(scan.aircraft, EntityId{0});
    EXPECT_GE(scan.time, last);
    last = scan.time;
    ++(scan.sensor == 0 ? first : second);
  }
  EXPECT_EQ(second, 31) << "one in each step, though the agent thinks every five";
  EXPECT_EQ(first, 31 - 10);
}

TEST(Run, AFailedLinkLosesMessagesInBothDirections) {
  World world = make_world(2, Time(), 0, [](std::size_t i, VehicleParts& parts) {
    if (i == 0)
      parts.faults = {{VehicleFault::Kind::kLink, 0, Time(), Time::from_seconds(100)}};
  });
  Notes notes;
  Silent console;
  ASSERT_TRUE(run(world, seconds(4), notes, console).ok());
  EXPECT_EQ(notes.kinds.find("heard"), std::string::npos);
  EXPECT_EQ(notes.text.find("heard"), std::string::npos);
  EXPECT_EQ(notes.messages, 2 * 9) << "lost ones are recorded too";
}

TEST(Run, AMotionThatIsNoLongerFiniteEndsThatAircraftOnly) {
  World world = make_world(2, Time(), 0, [](std::size_t i, VehicleParts& parts) {
    if (i == 1) parts.plant = std::make_shared<Glider>(50);
  });
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_NE(notes.text.find("1 accident the motion of a1 is no longer finite; before it "
                            "was at 50.0 m north"),
            std::string::npos)
      << notes.text;
  EXPECT_EQ(notes.text.find("0 accident"), std::string::npos);
}

// Out of memory in the third step, as a grid that grows with the fire may be.
class Hungry : public NoFire {
 public:
  void advance(Time now) override {
    if (now >= Time::from_seconds(3)) throw std::bad_alloc();
  }
};

TEST(Run, SaysWhenMemoryRanOut) {
  World world = make_world(1);
  world.fire = std::make_unique<Hungry>();
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(outcome.error().message.find("not enough memory (at 3.000 s"),
            std::string::npos)
      << outcome.error().text();
}

// A check of our own code fails in the third second.
class Faulty : public NoFire {
 public:
  void advance(Time now) override {
    SKEIN_CHECK(now < Time::from_seconds(3), "front", 7);
  }
};

TEST(Run, SaysWhenSkeinItselfHasABug) {
  World world = make_world(1);
  world.fire = std::make_unique<Faulty>();
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(10), notes, console);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, ErrorCode::kInternal);
  const std::string text = outcome.error().text();
  EXPECT_TRUE(text.starts_with("internal error: ")) << text;
  EXPECT_NE(text.find("front 7 (at 3.000 s of simulated time). This is a bug in Skein, "
                      "please report it."),
            std::string::npos)
      << text;
}

// Asks to stop from a moment of the wall clock on.
class Impatient : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return Clock::now() >= stop_; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point stop_ = Clock::now() + std::chrono::milliseconds(300);
};

TEST(Run, StopsAtOnceWhenASlowPaceSleeps) {
  World world = make_world(1);
  Notes notes;
  Impatient console;
  RunOptions options = seconds(10);
  options.speed = 0.001;  // a step every 100 s
  const auto begun = std::chrono::steady_clock::now();
  const auto outcome = run(world, options, notes, console);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().end, RunOutcome::End::kStopped);
  EXPECT_EQ(notes.truths, 1) << "the step that was not yet due is not done";
  // Asked after 0.3 s; 0.2 s to answer, and as much again for a busy machine.
  EXPECT_LT(took.count(), 0.7);
}

TEST(Run, TakesNoEntitiesAndNoTime) {
  World world = make_world(0);
  Notes notes;
  Silent console;
  const auto outcome = run(world, seconds(0), notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().simulated, Time());
}

TEST(Run, KeepsPaceWithTheClock) {
  World world = make_world(1);
  Notes notes;
  Silent console;
  RunOptions options = seconds(2);
  options.speed = 10;
  const auto outcome = run(world, options, notes, console);
  ASSERT_TRUE(outcome.ok());
  EXPECT_GE(outcome.value().wall_s, 0.2);  // never faster than asked; how much slower
                                           // depends on the machine
}

// Gives commands when it is asked for the n-th time, from 1.
class Operator : public Silent {
 public:
  std::map<int, std::vector<Command>> plan;
  int asked = 0;
  std::vector<CommandRecord> commands() override {
    std::vector<CommandRecord> given;
    for (const Command& command : plan[++asked])
      given.push_back({Time(), "operator", command});
    return given;
  }
};

// A ground station that puts into force what is commanded, and writes when.
class Office : public Agent {
 public:
  void step(const AgentInput& in, AgentOutput& out) override {
    for (const Command& command : in.commands)
      if (const auto* change = std::get_if<ZoneChange>(&command)) {
        out.events.push_back({in.now, EntityId{2}, "command", change->zone.name});
        out.records.emplace_back(*change);
      }
  }
};

class ZoneNotes : public Notes {
 public:
  void record(const Record& record) override {
    Notes::record(record);
    if (const auto* zone = std::get_if<ZoneRecord>(&record))
      zones += fmt::format("{:.1f} {} {};", zone->time.seconds(), zone->change.on,
                           zone->change.zone.name);
  }
  std::string zones;
};

void add_station(World& world) {
  Entity station;
  station.name = "station";
  station.kind = "station";
  station.agent = std::make_unique<Office>();
  station.agent_period = Time::from_seconds(0.5);
  station.active = {{Time(), Time::from_seconds(100)}};
  world.entities.push_back(std::move(station));
}

TEST(Run, PassesCommandsOnToGroundStationsAndRecordsThem) {
  World world = make_world(2);
  add_station(world);
  world.zones.push_back({.area = Disc{{0, 0}, 50}, .name = "known"});
  ZoneNotes notes;
  Operator console;
  console.plan[10] = {ZoneChange{0, true, {.area = Disc{{0, 0}, 50}, .name = "drawn"}}};
  ASSERT_TRUE(run(world, seconds(3), notes, console).ok());
  // Asked at 0.9 s, thought of at the station's next step; aircraft get nothing of it.
  EXPECT_EQ(notes.zones, "0.0 true known;1.0 true drawn;");
  EXPECT_NE(notes.kinds.find("command"), std::string::npos);
  ASSERT_EQ(notes.commands.size(), 1u);
  EXPECT_EQ(notes.commands[0].time, Time::from_seconds(0.9));
  EXPECT_EQ(notes.commands[0].sender, "operator");
}

TEST(Run, APausedRunStandsStillAndMakesTheStepsThatAreAskedFor) {
  World world = make_world(1);
  Notes notes;
  Operator console;
  // Asked once a step, and again and again while it stands still.
  console.plan[11] = {PauseCommand{true}};
  console.plan[14] = {StepCommand{3}};
  console.plan[20] = {PauseCommand{false}};
  RunOptions options = seconds(3);
  ASSERT_TRUE(run(world, options, notes, console).ok());
  ASSERT_EQ(notes.commands.size(), 3u);
  EXPECT_EQ(notes.commands[0].time, Time::from_seconds(1.0));
  EXPECT_EQ(notes.commands[1].time, Time::from_seconds(1.0));
  EXPECT_EQ(notes.commands[2].time, Time::from_seconds(1.3));
  EXPECT_EQ(notes.truths, 31) << "nothing is lost by standing still";
}

TEST(Run, CommandsOfARecordedRunGiveTheSameRecordsAgain) {
  const auto fly = [](RunOptions options, Operator& console, Notes& notes) {
    World world =
        make_world(3, Time::from_seconds(0.2), 0, [](std::size_t, VehicleParts& parts) {
          parts.breakable = {{VehicleFault::Kind::kLink, 0, {}, {}, "link"}};
        });
    world.entities[2].active.clear();
    ASSERT_TRUE(run(world, options, notes, console).ok());
  };
  Notes first, second;
  Operator console, nobody;
  console.plan[5] = {WindCommand{{3, 4}}, FaultCommand{"a0", "link", true}};
  console.plan[12] = {PauseCommand{true}};
  console.plan[15] = {AddCommand{"a2"}, PauseCommand{false}, SpeedCommand{1000}};
  console.plan[30] = {RemoveCommand{"a1"}, FaultCommand{"a0", "link", false},
                      FaultCommand{"a0", "wing", true}, AddCommand{"nobody"}};
  fly(seconds(6), console, first);
  RunOptions again = seconds(6);
  again.commands = first.commands;
  again.clock_by_command = false;
  fly(again, nobody, second);
  EXPECT_EQ(first.text, second.text);
  ASSERT_EQ(second.commands.size(), 10u);
  EXPECT_EQ(first.kinds,
            "joined joined failure joined command-refused command-refused left "
            "repaired ");
}

}  // namespace
}  // namespace skein::simulation
