// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_drive.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "skein/geo/rotation.h"
#include "skein/link/physics/test/servo_datagram.h"
#include "skein/link/physics/test/sitl_reader.h"

namespace skein::physics::ardupilot_drive_test {
namespace {

using namespace std::chrono_literals;

geo::LocalFrame driven_frame() {
  return geo::LocalFrame::at({36.989, -122.0514, 0}).value();
}

// A program that asks a drive for steps in a thread of its own until it is told to stop.
class AskingProgram {
 public:
  AskingProgram(std::uint16_t port, std::uint16_t first_pwm_us) {
    thread_ = std::thread([this, port, first_pwm_us] { run(port, first_pwm_us); });
  }
  AskingProgram(const AskingProgram&) = delete;
  AskingProgram& operator=(const AskingProgram&) = delete;
  ~AskingProgram() {
    stop_ = true;
    thread_.join();
  }
  double time() const { return time_; }
  int answers() const { return answers_; }

 private:
  void run(std::uint16_t port, std::uint16_t first_pwm_us) {
    const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::connect(fd, reinterpret_cast<sockaddr*>(&to), sizeof to);
    SitlReader reader;
    std::uint32_t count = 0;
    while (!stop_) {
      const std::string frame = servo_datagram(count, 16, first_pwm_us);
      ::send(fd, frame.data(), frame.size(), 0);
      // A frame that is not answered is sent again, as SITL does.
      for (int k = 0; k < 100 && !stop_; ++k) {
        pollfd ready{fd, POLLIN, 0};
        if (::poll(&ready, 1, 10) <= 0) continue;
        char text[4096];
        const ssize_t got = ::recv(fd, text, sizeof text, 0);
        if (got <= 0) continue;
        const auto values = reader.read({text, static_cast<std::size_t>(got)});
        if (!values) continue;
        time_ = values->at("timestamp")[0];
        ++answers_;
        ++count;
        break;
      }
    }
    ::close(fd);
  }

  std::atomic<bool> stop_ = false;
  std::atomic<double> time_ = 0;
  std::atomic<int> answers_ = 0;
  std::thread thread_;
};

struct DriveStand {
  explicit DriveStand(Patience patience = {10'000ms, 10'000ms}) {
    ArduPilotDriveOptions options;
    options.name = "a";
    options.port = 0;
    options.patience = patience;
    drive = std::make_unique<ArduPilotDrive>(
        options, driven_frame(),
        ChannelMap::usual(ChannelMap::Make::kArduPilot, FixedWingAirframe{}).value(),
        DrivingProgram(), clock);
    EXPECT_TRUE(drive->open());
    drive->begin(now);
  }
  bool step() {
    now += Time::from_ns(2'500'000);
    SensedMotion motion;
    motion.time = now;
    motion.dt = 0.0025;
    motion.f_B = {0, 0, -9.80665};
    return drive->exchange(motion, channels);
  }
  std::vector<EventLabel> events() {
    std::vector<OutsideEvent> all;
    drive->take_events(now, all);
    std::vector<EventLabel> kinds;
    for (const OutsideEvent& event : all) kinds.push_back(event.kind);
    return kinds;
  }

  Time now = Time::from_seconds(100);  // it joins a run under way
  DriveClock clock = std::make_shared<std::atomic<std::int64_t>>(0);
  std::unique_ptr<ArduPilotDrive> drive;
  std::array<float, 5> channels{};
};

using Kinds = std::vector<EventLabel>;

TEST(ArduPilotDrive, GoesStepByStepWithTheProgram) {
  DriveStand stand;
  // 1500, 1501, 1502 (of a throttle), 1503 us.
  const AskingProgram program(stand.drive->port(), 1500);
  for (int k = 0; k < 400; ++k) ASSERT_TRUE(stand.step()) << k;
  EXPECT_EQ(stand.events(), Kinds{EventKind::kAutopilotHeard});
  EXPECT_EQ(*stand.clock, stand.now.ns());
  EXPECT_NEAR(program.time(), 1, 0.006) << "its clock begins with the flight";
  EXPECT_EQ(stand.channels[0], 0);
  EXPECT_NEAR(stand.channels[1], -0.002, 1e-7);
  EXPECT_NEAR(stand.channels[3], 0.502, 1e-7);
  EXPECT_NEAR(stand.channels[2], -0.006, 1e-7);
}

TEST(ArduPilotDrive, TheWorldGoesOnWithoutASilentProgramAndHearsItAgain) {
  DriveStand stand({10'000ms, 50ms});
  {
    const AskingProgram program(stand.drive->port(), 1600);
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(stand.step());
  }
  const std::array<float, 5> before = stand.channels;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 40; ++k) stand.step();
  const auto silence = std::chrono::steady_clock::now() - begin;
  EXPECT_GE(silence, 50ms + 80ms) << "the patience once, then real time";
  EXPECT_LT(silence, 5s);
  EXPECT_EQ(stand.events(),
            (Kinds{EventKind::kAutopilotHeard, EventKind::kAutopilotSilent}));
  EXPECT_EQ(stand.channels, before) << "the last controls hold";
  const AskingProgram again(stand.drive->port(), 1700);
  for (int k = 0; k < 4000 && again.answers() < 10; ++k) stand.step();
  EXPECT_EQ(stand.events(), Kinds{EventKind::kAutopilotBack});
  EXPECT_NEAR(stand.channels[0], 0.4, 1e-7);
  EXPECT_LT(again.time(), 15) << "its clock begins anew";
}

TEST(ArduPilotDrive, WaitsForAFirstSignOnce) {
  DriveStand stand({100ms, 10'000ms});
  EXPECT_FALSE(stand.step());
  EXPECT_EQ(stand.events(), Kinds{EventKind::kAutopilotSilent});
  EXPECT_FALSE(stand.step());
  EXPECT_EQ(stand.events(), Kinds());
}

TEST(ArduPilotDrive, SaysThatItsPortIsTaken) {
  DriveStand stand;
  ArduPilotDriveOptions options;
  options.name = "b";
  options.port = stand.drive->port();
  ArduPilotDrive second(
      options, driven_frame(),
      ChannelMap::usual(ChannelMap::Make::kArduPilot, FixedWingAirframe{}).value(),
      DrivingProgram(), stand.clock);
  EXPECT_FALSE(second.open());
}

// As SITL makes a place of it (Location::offset of 4.5.7).
TEST(SitlPlace, IsWhereTheFrameMeans) {
  const geo::LocalFrame frame = driven_frame();
  const SitlHome home{36.989, -122.0514, 120};
  for (const Vec3& p_N :
       {Vec3(0, 0, -120), Vec3(8000, -5000, -300), Vec3(-40, 7000, 0)}) {
    const Vec3 d = sitl_place(p_N, frame, home);
    const double lat = home.latitude_deg + d.x() / 111'318.84502145034;
    const double mean = geo::radians((lat + home.latitude_deg) / 2);
    const double lon = home.longitude_deg + d.y() / 111'318.84502145034 / std::cos(mean);
    EXPECT_LT((frame.to_plane(lat, lon) - geo::horizontal(p_N)).norm(), 1e-3);
    EXPECT_DOUBLE_EQ(home.alt_msl - d.z(), -p_N.z());
  }
}

}  // namespace
}  // namespace skein::physics::ardupilot_drive_test
