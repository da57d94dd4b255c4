// SPDX-License-Identifier: Apache-2.0
// Vehicles whose flight model is in another program, as scenarios have them.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/world/build.h"
#include "skein/assemble/world/run.h"
#include "skein/data/vehicle/air.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/record/store/fan_out.h"
#include "skein/record/store/summary_recorder.h"
#include "skein/role/vehicle.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::flight_model_kind_test {
namespace {

std::string outside_text(const std::string& vehicle, const std::string& more = "",
                         const std::string& step = "0.02") {
  return fmt::format(R"(
duration_s: 14
step_s: {}
origin: {{latitude_deg: 36.989, longitude_deg: -122.0514}}
environment: {{terrain: flat, wind: {{kind: uniform, speed_mps: 0}}, phenomena: []}}
missions: []
aircraft:
  - count: 1
    vehicle: {{kind: flight-model, {}}}
    plant: {{kind: fixed-wing, aircraft: aerosonde}}
    autopilot: skein
    agent: {{kind: route, points_m: [[3000, 0], [3000, 3000]]}}
    sensors: [ideal-navigation, fire]
    altitude_agl_m: 200
    start: {{placement: list, positions_m: [[100, 0]], heading_deg: 0}}
    {}
)",
                     step, vehicle, more);
}

Result<Build> outside_build(const std::string& vehicle, const std::string& more = "",
                            const std::string& step = "0.02") {
  const KindRegistry kinds;
  const auto read = scenario::read_scenario_text(
      outside_text(vehicle, more, step), "outside", SKEIN_SOURCE_DIR, kinds.table());
  if (!read.ok()) return Error{ErrorCode::kBadInput, "", read.report(), ""};
  return build(*read.scenario, kinds);
}

std::string outside_error(const std::string& vehicle, const std::string& more = "",
                          const std::string& step = "0.02") {
  const auto built = outside_build(vehicle, more, step);
  return built ? std::string() : built.error().text();
}

TEST(FlightModelKind, IsVirtualAndInRealTime) {
  const auto built = outside_build("in: 'udpin:0', contact_s: 0");
  ASSERT_TRUE(built) << built.error().text();
  EXPECT_TRUE(built.value().mixed);
  const simulation::Entity& entity = built.value().world.entities[1];
  EXPECT_EQ(entity.reality.presence, Reality::kVirtual);
  ASSERT_TRUE(entity.vehicle->truth());
  EXPECT_NEAR(entity.vehicle->truth()->p_N.x(), 100, 1e-9) << "where it is to begin";
}

TEST(FlightModelKind, SaysWhatDoesNotFit) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(outside_error("in: 'tcpin:5'"), "udpin:PORT");
  has(outside_error("out: 'udpin:5'"), "udpout:HOST:PORT");
  has(outside_error("program: sextant"), "flightgear");
  has(outside_error("in: 'udpin:0', contact_s: 0", "", "0.1"), "step_s: 0.02");
  has(outside_error("in: 'udpin:0', contact_s: 0", "failures: [{kind: motor, at_s: 5}]"),
      "flight model's");
  EXPECT_EQ(outside_error("in: 'udpin:0', contact_s: 0",
                          "failures: [{kind: sensor, part: fire, at_s: 5}]"),
            "");
  EXPECT_EQ(outside_error("program: x-plane, in: '', out: 'udpout:127.0.0.1:49000'"), "");
}

// Plays FlightGear with a plant of Skein's, in real time and a thread of its own.
class StandInFlightGear {
 public:
  StandInFlightGear() : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    // Two free ports: one stays open for controls, the other is the run's.
    out_port_ = bound(fd_);
    const int other = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    in_port_ = bound(other);
    ::close(other);
  }
  StandInFlightGear(const StandInFlightGear&) = delete;
  StandInFlightGear& operator=(const StandInFlightGear&) = delete;
  ~StandInFlightGear() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    ::close(fd_);
  }
  void start() {
    thread_ = std::thread([this] { run(); });
  }
  std::string keys() const {
    return fmt::format("in: 'udpin:{}', out: 'udpout:127.0.0.1:{}'", in_port_, out_port_);
  }
  std::atomic<bool> paused = false;

 private:
  static sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return at;
  }
  static std::uint16_t bound(int fd) {
    sockaddr_in at = loopback(0);
    EXPECT_EQ(::bind(fd, reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
    socklen_t size = sizeof at;
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&at), &size);
    return ntohs(at.sin_port);
  }

  void run() {
    const auto frame = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
    const asset::FixedWingPlant plant(
        *load_aircraft("aerosonde", ".").value().fixed_wing);
    VehicleStart begin;
    begin.p_N = {100, 0, -200};
    VehicleState state = plant.start(begin);
    Actuators actuators;
    double time = 0;
    auto due = std::chrono::steady_clock::now();
    for (int k = 0; !stop_; ++k) {
      due += std::chrono::milliseconds(10);
      std::this_thread::sleep_until(due);
      hear(actuators);
      if (paused) continue;
      plant.step(state, actuators, Air{}, 0.01);
      time += 0.01;
      if (k % 2 == 0) say(frame, state, time);
    }
  }

  // The newest line; its elevator is the plant's, its rudder is not.
  void hear(Actuators& actuators) const {
    char text[512];
    for (;;) {
      const ssize_t got = ::recv(fd_, text, sizeof text, MSG_DONTWAIT);
      if (got <= 0) return;
      std::array<double, 4> numbers{};
      const char* at = text;
      for (double& number : numbers) at = std::from_chars(at, text + got, number).ptr + 1;
      actuators[channel::kAileron] = numbers[0];
      actuators[channel::kElevator] = numbers[1];
      actuators[channel::kRudder] = -numbers[2];
      actuators[channel::kThrottle] = numbers[3];
    }
  }

  void say(const geo::LocalFrame& frame, const VehicleState& s, double time) const {
    constexpr double kFootLength = 0.3048;
    const geo::Geodetic at = frame.from_plane(geo::horizontal(s.p_N));
    const geo::Euler attitude = geo::to_euler(s.q_NB);
    const Vec3 v_fps = s.v_N / kFootLength;
    const std::string line = fmt::format(
        "skein-1,{:.6f},{:.9f},{:.9f},{:.4f},{:.6f},{:.6f},{:.6f},{:.7f},{:.7f},{:.7f},"
        "{:.5f},{:.5f},{:.5f},0.0000,0.0000,1.00000,0,0,0\n",
        time, at.latitude_deg, at.longitude_deg, -s.p_N.z() / kFootLength,
        geo::degrees(attitude.roll), geo::degrees(attitude.pitch),
        geo::degrees(attitude.yaw), s.w_NB_B.x(), s.w_NB_B.y(), s.w_NB_B.z(), v_fps.x(),
        v_fps.y(), v_fps.z());
    const sockaddr_in to = loopback(in_port_);
    ::sendto(fd_, line.data(), line.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
  }

  int fd_;
  std::uint16_t in_port_ = 0, out_port_ = 0;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Keeps what comes from outside and what happens; pauses the program for a while.
struct OutsideLog final : Recorder {
  void record(const Record& record) override {
    if (const auto* report = std::get_if<VehicleReportRecord>(&record))
      reports.push_back(*report);
    if (const auto* event = std::get_if<Event>(&record))
      if (event->kind.name().starts_with("flight-model")) events.push_back(event->kind);
  }
  Result<void> step_done(Time now) override {
    if (program)
      program->paused = now > Time::from_seconds(10) && now < Time::from_seconds(11);
    return {};
  }
  StandInFlightGear* program = nullptr;
  std::vector<VehicleReportRecord> reports;
  std::vector<EventLabel> events;
};

struct QuietDesk final : OperatorConsole {
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return false; }
};

record::RunSummary fly(Build& ready, OutsideLog& log) {
  record::SummaryRecorder figures({"test", 0, "outside", "", ""});
  record::FanOut all({&figures, &log});
  QuietDesk desk;
  const auto done = run_linked(ready, &all, desk);
  EXPECT_TRUE(done) << done.error().text();
  return figures.summary();
}

// Over sockets, in real time: a plant in another thread is flown along a line, is paused
// for a second and flown on. What it said makes the same run again.
TEST(FlightModelKind, FliesAnOutsidePlantAndDoesTheRunAgainWithoutIt) {
  StandInFlightGear program;
  const std::string vehicle = program.keys() + ", contact_s: 20";
  auto built = outside_build(vehicle);
  ASSERT_TRUE(built) << built.error().text();
  program.start();
  ASSERT_TRUE(open_links(built.value()));
  built.value().options.speed = 1;
  OutsideLog log;
  log.program = &program;
  const record::RunSummary flown = fly(built.value(), log);
  EXPECT_EQ(log.events, (std::vector<EventLabel>{EventKind::kFlightModelHeard,
                                                 EventKind::kFlightModelSilent,
                                                 EventKind::kFlightModelBack}));
  double off = 0, high = 0, north = 0;
  int motions = 0;
  for (const VehicleReportRecord& each : log.reports)
    if (const auto* motion = std::get_if<VehicleMotion>(&each.value)) {
      ++motions;
      off = std::max(off, std::abs(motion->p_N.y()));
      high = std::max(high, std::abs(motion->p_N.z() + 200));
      north = motion->p_N.x();
    }
  EXPECT_GT(motions, 200) << "50 a second, on a machine with other work";
  EXPECT_GT(north, 300) << "at 25 m/s";
  // It begins on the line in level flight; without control it would be far off by now.
  EXPECT_LT(off, 10);
  EXPECT_LT(high, 10);

  const KindRegistry kinds;
  const auto read = scenario::read_scenario_text(outside_text(vehicle), "outside",
                                                 SKEIN_SOURCE_DIR, kinds.table());
  ASSERT_TRUE(read.ok());
  auto again = build(*read.scenario, kinds, log.reports);
  ASSERT_TRUE(again) << again.error().text();
  again.value().options.speed = 0;
  OutsideLog second;
  const record::RunSummary replayed = fly(again.value(), second);
  EXPECT_EQ(replayed.content_hash, flown.content_hash);
  EXPECT_EQ(second.events, log.events);
}

}  // namespace
}  // namespace skein::assemble::flight_model_kind_test
