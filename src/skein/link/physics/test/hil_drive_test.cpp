// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil_drive.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>

#include "skein/link/mavlink/frame_writer.h"

namespace skein::physics::hil_drive_test {
namespace {

using namespace std::chrono_literals;

struct HilStand {
  explicit HilStand(bool lock_step, Patience patience) {
    HilDriveOptions options;
    options.name = "a";
    options.link = {transport::TcpServer{}, lock_step};
    options.patience = patience;
    const auto frame = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
    drive = std::make_unique<HilDrive>(
        options,
        HilSensing(frame, RandomStream(1, 1, Purpose::kOutsideSensors), 0, std::nullopt),
        ChannelMap::usual(ChannelMap::Make::kPx4, FixedWingAirframe{}).value(),
        DrivingProgram(), clock);
    EXPECT_TRUE(drive->open());
    drive->begin(Time());
  }
  SensedMotion motion() const {
    SensedMotion m;
    m.time = now;
    m.dt = 0.004;
    m.f_B = {0, 0, -9.80665};
    m.airspeed = 20;
    m.p_N = {0, 0, -100};
    return m;
  }
  bool step() {
    now += Time::from_ns(4'000'000);
    return drive->exchange(motion(), channels);
  }
  // An autopilot that has connected.
  int connect() const {
    const std::string place = drive->place();
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1))));
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
    return fd;
  }
  std::vector<EventLabel> events() {
    std::vector<OutsideEvent> all;
    drive->take_events(now, all);
    std::vector<EventLabel> kinds;
    for (const OutsideEvent& event : all) kinds.push_back(event.kind);
    return kinds;
  }

  Time now;
  DriveClock clock = std::make_shared<std::atomic<std::int64_t>>(0);
  std::unique_ptr<HilDrive> drive;
  std::array<float, 5> channels{};
};

// An autopilot that answers whatever comes with the same controls.
class Answering {
 public:
  explicit Answering(int fd) : thread_([this, fd] { run(fd); }) {}
  Answering(const Answering&) = delete;
  Answering& operator=(const Answering&) = delete;
  ~Answering() {
    stop_ = true;
    thread_.join();
  }

 private:
  void run(int fd) {
    mavlink::FrameWriter writer(1, 1);
    mavlink::HilActuatorControls controls;
    controls.controls[0] = 0.5F;
    controls.controls[1] = 0.25F;
    controls.controls[2] = 0.125F;
    controls.controls[3] = 0.75F;
    while (!stop_) {
      pollfd ready{fd, POLLIN, 0};
      std::byte bytes[4096];
      if (::poll(&ready, 1, 10) <= 0 || ::read(fd, bytes, sizeof bytes) <= 0) continue;
      const auto frame = writer.write(controls);
      if (::write(fd, frame.data(), frame.size()) < 0) return;
    }
  }

  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

TEST(HilDrive, MovesThePlantAsItsAutopilotSays) {
  HilStand stand(true, {10'000ms, 1000ms});
  const int fd = stand.connect();
  {
    const Answering autopilot(fd);
    bool answered = false;
    for (int k = 0; k < 1000 && !answered; ++k) answered = stand.step();
    ASSERT_TRUE(answered);
  }
  EXPECT_EQ(stand.channels[channel::kAileron], 0.5F);
  EXPECT_EQ(stand.channels[channel::kElevator], -0.25F);
  EXPECT_EQ(stand.channels[channel::kRudder], -0.125F);
  EXPECT_EQ(stand.channels[channel::kThrottle], 0.75F);
  EXPECT_EQ(*stand.clock, stand.now.ns());
  EXPECT_EQ(stand.events(), std::vector<EventLabel>{EventKind::kAutopilotHeard});
  for (int k = 0; k < 5; ++k) stand.step();
  EXPECT_EQ(stand.events(), std::vector<EventLabel>{EventKind::kAutopilotSilent});
  EXPECT_EQ(stand.channels[channel::kThrottle], 0.75F);
  ::close(fd);
}

TEST(HilDrive, TakesAsLongAsTheWallClockForHardware) {
  HilStand stand(false, {10'000ms, 10'000ms});
  EXPECT_TRUE(stand.drive->real_time());
  const int fd = stand.connect();
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 50; ++k) stand.step();
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 195ms);
  ::close(fd);
}

TEST(HilSensing, MeasuresTheMotion) {
  HilStand stand(true, {});
  stand.now = Time::from_seconds(2);
  const auto frame = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  HilSensing sensing(frame, RandomStream(1, 1, Purpose::kOutsideSensors), 5'000'000,
                     geo::radians(13));
  const HilSensors sensors = sensing.sensors(stand.motion());
  EXPECT_EQ(sensors.time, stand.now);
  EXPECT_NEAR(sensors.imu->f_B.z(), -9.80665, 0.3);  // six deviations
  EXPECT_NEAR(sensors.barometer->pressure, 100'129, 9);
  EXPECT_NEAR(sensors.barometer->altitude, 100, 0.8);
  EXPECT_NEAR(*sensors.pitot_pressure, 242.6, 12);
  const Vec3 field = *sensors.field_B_gauss;
  EXPECT_NEAR(geo::degrees(geo::bearing(geo::horizontal(field))), 13, 4);
  const HilFix fix = sensing.fix(stand.motion());
  EXPECT_EQ(fix.utc_us, 7'000'000);
  EXPECT_NEAR(fix.latitude_deg, 36.989, 3e-5);
  EXPECT_NEAR(fix.alt_msl, 100, 3);
  const HilTruth truth = sensing.truth(stand.motion());
  EXPECT_NEAR(truth.a_B.norm(), 0, 1e-12);
  EXPECT_NEAR(truth.indicated_airspeed, 19.9, 0.05);
}

}  // namespace
}  // namespace skein::physics::hil_drive_test
