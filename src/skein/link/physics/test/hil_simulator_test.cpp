// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_simulator.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace skein::physics::hil_simulator_test {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

// The autopilot's side of a line.
class AutopilotEnd {
 public:
  explicit AutopilotEnd(int fd) : fd_(fd) {}
  AutopilotEnd(const AutopilotEnd&) = delete;
  AutopilotEnd& operator=(const AutopilotEnd&) = delete;
  ~AutopilotEnd() { ::close(fd_); }

  template <mavlink::Message T>
  void send(const T& message) {
    const auto frame = writer_.write(message);
    EXPECT_EQ(::write(fd_, frame.data(), frame.size()),
              static_cast<ssize_t>(frame.size()));
  }
  void send_controls(std::uint64_t time_usec, float first) {
    mavlink::HilActuatorControls m;
    m.time_usec = time_usec;
    m.controls[0] = first;
    m.mode = 0x81;
    m.flags = 1;
    send(m);
  }
  void ask_for_the_truth() {
    mavlink::CommandLong m;
    m.command = 511;
    m.param1 = 115;
    m.param2 = 5000;
    send(m);
  }

  // Waits for the next message of a kind, passing over others; none after the patience.
  template <mavlink::Message T>
  std::optional<T> next(std::chrono::milliseconds patience = 10s) {
    const Clock::time_point until = Clock::now() + patience;
    for (;;) {
      while (!held_.empty()) {
        const auto [id, payload] = held_.front();
        held_.erase(held_.begin());
        if (id == mavlink::kFacts<T>.id) return mavlink::unpack<T>(payload);
      }
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
      pollfd ready{fd_, POLLIN, 0};
      if (left < 0ms || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0) return {};
      std::byte bytes[4096];
      const ssize_t got = ::read(fd_, bytes, sizeof bytes);
      if (got <= 0) return {};
      parser_.read(std::span(bytes).first(static_cast<std::size_t>(got)),
                   [this](const mavlink::Frame& frame) {
                     const auto payload = frame.payload();
                     held_.emplace_back(frame.id(),
                                        std::vector(payload.begin(), payload.end()));
                   });
    }
  }

 private:
  int fd_;
  mavlink::FrameWriter writer_{1, 1};
  mavlink::FrameParser parser_;
  std::vector<std::pair<std::uint32_t, std::vector<std::byte>>> held_;
};

// A simulator that waits at any free port.
struct World {
  explicit World(const HilOptions& options) {
    auto opened = HilSimulator::open(options);
    EXPECT_TRUE(opened.ok()) << opened.error().text();
    simulator = std::move(opened).value();
  }
  World() : World(HilOptions{transport::TcpServer{}}) {}

  // A program that has connected.
  std::unique_ptr<AutopilotEnd> connect() const {
    const std::string place = simulator->place();
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1))));
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    return std::make_unique<AutopilotEnd>(fd);
  }
  // Waits up to 10 s, as a world that stands still.
  bool serve_until(const std::function<bool()>& done) const {
    for (int k = 0; k < 1000 && !done(); ++k) simulator->serve(10ms);
    return done();
  }

  HilReply step(std::chrono::milliseconds patience) {
    time += step_length;
    HilSensors sensors;
    sensors.time = time;
    sensors.imu = HilImu{{0, 0, -9.80665}, Vec3::Zero()};
    return simulator->step(sensors, patience);
  }
  std::uint64_t time_usec() const { return static_cast<std::uint64_t>(time.ns() / 1000); }

  std::unique_ptr<HilSimulator> simulator;
  Time time, step_length = Time::from_ns(4'000'000);
};

TEST(HilSimulator, GoesOnWithoutAnAutopilot) {
  World world;
  const Clock::time_point before = Clock::now();
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(world.step(10s).outcome, HilOutcome::kNotConnected);
  EXPECT_LT(Clock::now() - before, 5s);  // no patience for nobody
  EXPECT_FALSE(world.simulator->connected());
}

// PX4's start: it asks for the truth, its clock is what the sensors bring, controls come
// once its programs run.
TEST(HilSimulator, RunsFreelyUntilTheFirstControlsThenStepByStep) {
  constexpr int kFreeSteps = 6, kSteps = 300;
  World world;
  // Longer than a slow machine takes for an answer.
  world.step_length = Time::from_ns(100'000'000);
  const auto first = [](std::uint64_t clock) { return static_cast<float>(clock) / 1e9F; };
  const auto line = world.connect();
  std::thread px4([&] {
    line->ask_for_the_truth();
    mavlink::Heartbeat heartbeat;
    heartbeat.autopilot = 12;
    line->send(heartbeat);
    const auto ack = line->next<mavlink::CommandAck>();
    EXPECT_TRUE(ack && ack->result == 0);
    std::uint64_t clock = 0;
    for (int k = 1; k <= kSteps; ++k) {
      const auto sensors = line->next<mavlink::HilSensor>();
      ASSERT_TRUE(sensors);
      EXPECT_EQ(sensors->time_usec, clock += 100'000);
      EXPECT_EQ(sensors->fields_updated, 0x3FU);
      if (k > kFreeSteps) line->send_controls(clock, first(clock));
    }
  });
  ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
  const Clock::time_point before = Clock::now();
  for (int k = 1; k <= kFreeSteps; ++k)
    EXPECT_EQ(world.step(10s).outcome, HilOutcome::kNoControls);
  // The free steps take their time, the others do not.
  EXPECT_GE(Clock::now() - before, (kFreeSteps - 1) * 100ms);
  for (int k = kFreeSteps + 1; k <= kSteps; ++k) {
    const HilReply reply = world.step(10s);
    EXPECT_EQ(reply.outcome, HilOutcome::kControls);
    EXPECT_EQ(reply.controls.time, world.time);
    EXPECT_TRUE(reply.controls.armed);
    EXPECT_TRUE(reply.controls.lock_step);
    EXPECT_EQ(reply.controls.channel[0], double{first(world.time_usec())});
  }
  px4.join();
  EXPECT_LT(Clock::now() - before, 20s);  // of 30 s that were simulated
  EXPECT_EQ(world.simulator->counts().controls, std::uint64_t{kSteps - kFreeSteps});
  EXPECT_EQ(world.simulator->counts().timeouts, 0U);
  EXPECT_EQ(world.simulator->counts().dropped, 0U);
}

TEST(HilSimulator, GoesOnAfterATimeoutAndComesBack) {
  World world;
  const auto line = world.connect();
  line->send_controls(1, 0.25F);
  ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
  // The controls came before a step: it answers from now on.
  world.simulator->serve(20ms);
  Clock::time_point before = Clock::now();
  HilReply reply = world.step(50ms);
  EXPECT_EQ(reply.outcome, HilOutcome::kTimedOut);
  EXPECT_EQ(reply.controls.channel[0], 0.25);
  EXPECT_GE(Clock::now() - before, 50ms);
  // Later steps do not wait for what does not answer.
  before = Clock::now();
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(world.step(10s).outcome, HilOutcome::kNoControls);
  EXPECT_LT(Clock::now() - before, 5s);
  EXPECT_EQ(world.simulator->counts().timeouts, 1U);
  // Late controls are none to the next step, but it answers again.
  line->send_controls(world.time_usec(), 0.5F);
  world.simulator->serve(20ms);
  reply = world.step(20ms);
  EXPECT_EQ(reply.outcome, HilOutcome::kTimedOut);
  EXPECT_EQ(reply.controls.channel[0], 0.5);
  std::thread px4([&] {
    while (const auto sensors = line->next<mavlink::HilSensor>())
      if (sensors->time_usec > 100'000) break;
    line->send_controls(0, 0.75F);
  });
  while (world.time < Time::from_seconds(0.1)) world.step(0ms);
  reply = world.step(10s);
  while (reply.outcome != HilOutcome::kControls && world.time < Time::from_seconds(10))
    reply = world.step(10s);
  px4.join();
  EXPECT_EQ(reply.outcome, HilOutcome::kControls);
  EXPECT_EQ(reply.controls.channel[0], 0.75);
}

TEST(HilSimulator, TakesAnAutopilotThatRebootsAndForgetsTheOneBefore) {
  World world;
  for (std::uint64_t boot = 1; boot <= 3; ++boot) {
    auto line = world.connect();
    line->send_controls(5, 0.5F);
    ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
    EXPECT_EQ(world.simulator->counts().connections, boot);
    // It comes with the next steps, free ones at first.
    HilReply reply = world.step(1ms);
    for (int k = 0; k < 1000 && reply.controls.channel[0] == 0; ++k)
      reply = world.step(1ms);
    EXPECT_EQ(reply.controls.channel[0], 0.5);
    EXPECT_TRUE(line->next<mavlink::HilSensor>());
    line.reset();
    ASSERT_TRUE(world.serve_until([&] { return !world.simulator->connected(); }));
    reply = world.step(10s);
    EXPECT_EQ(reply.outcome, HilOutcome::kNotConnected);
    EXPECT_EQ(reply.controls.channel[0], 0);
  }
}

TEST(HilSimulator, DoesNotWaitForAnAutopilotThatDiesInAStep) {
  World world;
  auto line = world.connect();
  line->send_controls(5, 0.5F);
  ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
  world.simulator->serve(20ms);
  std::thread px4([&] {
    std::this_thread::sleep_for(50ms);
    line.reset();
  });
  const Clock::time_point before = Clock::now();
  EXPECT_EQ(world.step(60s).outcome, HilOutcome::kNotConnected);
  EXPECT_LT(Clock::now() - before, 30s);
  px4.join();
}

TEST(HilSimulator, FollowsTheNewerOfTwo) {
  World world;
  const auto old = world.connect();
  ASSERT_TRUE(
      world.serve_until([&] { return world.simulator->counts().connections == 1; }));
  {
    const auto line = world.connect();
    ASSERT_TRUE(
        world.serve_until([&] { return world.simulator->counts().connections == 2; }));
    old->send_controls(1, -1);
    line->send_controls(1, 0.5F);
    world.simulator->serve(20ms);
    EXPECT_EQ(world.step(20ms).controls.channel[0], 0.5);
    EXPECT_TRUE(line->next<mavlink::HilSensor>());
  }
  ASSERT_TRUE(world.serve_until([&] { return !world.simulator->connected(); }));
}

TEST(HilSimulator, SendsWhatBelongsToAStepBeforeTheSensorsThatMoveTheClock) {
  World world;
  const auto line = world.connect();
  line->ask_for_the_truth();
  ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
  world.simulator->serve(20ms);
  HilFix fix;
  fix.satellites = 12;
  world.simulator->send(fix);
  HilSensors second;
  second.unit = 1;
  second.time = Time::from_seconds(0.004);
  second.field_B_gauss = Vec3(0.25, 0, 0.5);
  world.simulator->send(second);
  HilTruth truth;
  truth.alt_msl = 120;
  world.simulator->send(truth);
  world.step(20ms);
  EXPECT_TRUE(line->next<mavlink::Heartbeat>());
  const auto gps = line->next<mavlink::HilGps>();
  EXPECT_TRUE(gps && gps->satellites_visible == 12);
  auto sensors = line->next<mavlink::HilSensor>();
  EXPECT_TRUE(sensors && sensors->id == 1 && sensors->fields_updated == 0x1C0);
  const auto state = line->next<mavlink::HilStateQuaternion>();
  EXPECT_TRUE(state && state->alt == 120'000);
  sensors = line->next<mavlink::HilSensor>();
  EXPECT_TRUE(sensors && sensors->id == 0 && sensors->time_usec == 4000);
}

TEST(HilSimulator, SendsAHeartbeatEachSecondThoughTheWorldStandsStill) {
  World world;
  const auto line = world.connect();
  const Clock::time_point before = Clock::now();
  int heartbeats = 0;
  while (heartbeats < 3 && Clock::now() - before < 20s) {
    world.simulator->serve(50ms);
    while (line->next<mavlink::Heartbeat>(0ms)) ++heartbeats;
  }
  EXPECT_EQ(heartbeats, 3);
  EXPECT_GE(Clock::now() - before, 2s);  // the first one goes out at once
}

TEST(HilSimulator, NeedsTimeThatGoesOn) {
  World world;
  HilSensors sensors;
  EXPECT_THROW(world.simulator->step(sensors, 0ms), Bug);  // PX4's clock is above 0
  sensors.time = Time::from_ns(1000);
  world.simulator->step(sensors, 0ms);
  sensors.time = Time::from_ns(1999);
  EXPECT_THROW(world.simulator->step(sensors, 0ms), Bug);
  sensors.time = Time::from_ns(2000);
  world.simulator->step(sensors, 0ms);
}

TEST(HilSimulator, SaysWhereItCannotWait) {
  const World world;
  const auto taken =
      HilSimulator::open({transport::parse_endpoint(world.simulator->place()).value()});
  ASSERT_FALSE(taken.ok());
  EXPECT_NE(taken.error().text().find("in use"), std::string::npos);
  EXPECT_EQ(px4_port(0), 4560);
  EXPECT_EQ(px4_port(2), 4562);
}

TEST(HilSimulator, ServesHardwareOverALineInRealTime) {
  const int master = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(grantpt(master), 0);
  ASSERT_EQ(unlockpt(master), 0);
  termios raw{};
  ASSERT_EQ(tcgetattr(master, &raw), 0);
  cfmakeraw(&raw);
  ASSERT_EQ(tcsetattr(master, TCSANOW, &raw), 0);
  HilOptions options{transport::SerialLine{ptsname(master), 921'600}};
  options.lock_step = false;
  World world(options);
  EXPECT_EQ(world.simulator->place(), "");
  ASSERT_TRUE(world.serve_until([&] { return world.simulator->connected(); }));
  {
    AutopilotEnd board(master);
    world.simulator->serve(10ms);
    EXPECT_TRUE(board.next<mavlink::Heartbeat>());
    int with_controls = 0;
    const Clock::time_point before = Clock::now();
    for (int k = 0; k < 100; ++k) {
      if (k % 10 == 5) board.send_controls(0, 0.5F);
      const HilReply reply = world.step(10s);
      EXPECT_NE(reply.outcome, HilOutcome::kNotConnected);
      EXPECT_NE(reply.outcome, HilOutcome::kTimedOut);
      with_controls += reply.outcome == HilOutcome::kControls;
      const auto sensors = board.next<mavlink::HilSensor>();
      EXPECT_TRUE(sensors && sensors->time_usec == world.time_usec());
    }
    EXPECT_LT(Clock::now() - before, 10s);  // it has waited for no controls
    EXPECT_GE(with_controls, 1);
    EXPECT_EQ(world.step(0ms).controls.channel[0], 0.5);
  }
  ASSERT_TRUE(world.serve_until([&] { return !world.simulator->connected(); }));
}

}  // namespace
}  // namespace skein::physics::hil_simulator_test
