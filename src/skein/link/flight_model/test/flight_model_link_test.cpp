// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/flight_model_link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <thread>

#include "skein/link/flight_model/test/x_plane_packets.h"

namespace skein::flight_model::flight_model_link_test {
namespace {

using namespace std::chrono_literals;

geo::LocalFrame link_frame() {
  return geo::LocalFrame::at({36.989, -122.0514, 0}).value();
}

// The program's socket, at a free port of this machine.
class ProgramSocket {
 public:
  ProgramSocket() : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<sockaddr*>(&at), sizeof at), 0);
    socklen_t size = sizeof at;
    ::getsockname(fd_, reinterpret_cast<sockaddr*>(&at), &size);
    port_ = ntohs(at.sin_port);
  }
  ProgramSocket(const ProgramSocket&) = delete;
  ProgramSocket& operator=(const ProgramSocket&) = delete;
  ~ProgramSocket() { ::close(fd_); }

  std::uint16_t port() const { return port_; }
  void send(const std::string& datagram, std::uint16_t port) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::sendto(fd_, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&to),
             sizeof to);
  }
  // The next datagram, and where it came from; empty when none comes in time.
  std::string receive(std::uint16_t* from = nullptr) const {
    pollfd ready{fd_, POLLIN, 0};
    if (::poll(&ready, 1, 5000) <= 0) return {};
    char text[4096];
    sockaddr_in sender{};
    socklen_t size = sizeof sender;
    const ssize_t got = ::recvfrom(fd_, text, sizeof text, 0,
                                   reinterpret_cast<sockaddr*>(&sender), &size);
    if (from) *from = ntohs(sender.sin_port);
    return {text, got > 0 ? static_cast<std::size_t>(got) : 0};
  }

 private:
  int fd_;
  std::uint16_t port_ = 0;
};

FlightModelOptions options_to(const ProgramSocket& program) {
  FlightModelOptions options;
  options.name = "a1";
  options.out = transport::UdpClient{{"127.0.0.1", program.port()}};
  options.contact = 0ms;
  return options;
}

// The newest motion, once one has come.
std::optional<VehicleMotion> motion_of(FlightModelLink& link, Time now) {
  std::vector<VehicleReport> out;
  for (int k = 0; k < 500; ++k) {
    link.receive(now, out);
    for (auto report = out.rbegin(); report != out.rend(); ++report)
      if (const auto* motion = std::get_if<VehicleMotion>(&*report)) return *motion;
    std::this_thread::sleep_for(10ms);
  }
  return std::nullopt;
}

std::uint16_t port_at(const std::string& place) {
  return static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));
}

std::string line(double time, double north_fps) {
  return fmt::format("skein-1,{},36.989,-122.0514,1000,0,0,0,0,0,0,{},0,0,0,0,1,0,0,0\n",
                     time, north_fps);
}

TEST(FlightModelLink, FlightGearSaysStatesAndIsToldControls) {
  const ProgramSocket program;
  FlightModelOptions options = options_to(program);
  options.in = transport::UdpServer{};
  options.sends_wind = true;
  options.settling = 2;
  FlightModelLink link(options, link_frame(), flightgear(), std::nullopt);
  ASSERT_TRUE(link.open());
  ASSERT_EQ(link.places().size(), 1U);
  const std::uint16_t to = port_at(link.places()[0]);
  program.send(line(0, 999), to);  // before its flight model runs
  program.send("garbage", to);
  program.send(line(1.9, 999), to);  // before it has settled
  program.send(line(3, 100), to);
  const auto motion = motion_of(link, Time::from_seconds(7));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->v_N.x(), 30.48, 1e-9);
  EXPECT_LE(motion->time, Time::from_seconds(7));
  EXPECT_GT(motion->time, Time::from_seconds(6)) << "not long before it was taken";
  Actuators actuators;
  actuators[channel::kThrottle] = 0.5;
  link.send(actuators, {-3.048, 0, 0});
  EXPECT_EQ(program.receive(),
            "0.000000,0.000000,0.000000,0.500000,0.500000,0.000000,0.000000,"
            "10.0000,0.0000\n");
}

TEST(FlightModelLink, XPlaneIsAskedUntilItAnswers) {
  const ProgramSocket program;
  FlightModelLink link(options_to(program), link_frame(), x_plane(), std::nullopt);
  ASSERT_TRUE(link.open());
  std::uint16_t link_port = 0;
  EXPECT_EQ(program.receive(&link_port).substr(0, 4), "RPOS");
  EXPECT_EQ(program.receive().substr(0, 4), "RREF");
  program.send(rref({{0, 5.0F}, {2, 0.0F}}), link_port);
  XPlanePosition at;
  at.latitude_deg = 36.989;
  at.longitude_deg = -122.0514;
  at.msl_m = 250;
  program.send(rpos(at), link_port);
  const auto motion = motion_of(link, Time::from_seconds(7));
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->p_N.z(), -250, 1e-9);
  link.send(Actuators{}, Vec3::Zero());
  std::string next = program.receive();
  while (next.substr(0, 4) == "RREF") next = program.receive();
  EXPECT_EQ(next.substr(0, 4), "DREF");
  EXPECT_STREQ(next.data() + 9, "sim/operation/override/override_joystick");
}

TEST(FlightModelLink, AProgramThatEndsBeforeItSaysAnythingEndsTheRun) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "flight_model_link_test";
  const ProgramSocket program;
  FlightModelOptions options = options_to(program);
  options.in = transport::UdpServer{};
  options.contact = 20'000ms;
  options.files.emplace_back((folder / "Protocol/skein.xml").string(), "content");
  process::Program started;
  started.arguments = {"sh", "-c", "echo no display; exit 3"};
  started.folder = folder;
  started.log = folder / "log";
  FlightModelLink link(options, link_frame(), flightgear(),
                       process::KeptProgram(started, false));
  const auto opened = link.open();
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("no display"), std::string::npos)
      << opened.error().text();
  std::ifstream in(folder / "Protocol/skein.xml");
  std::string text;
  in >> text;
  EXPECT_EQ(text, "content");
}

}  // namespace
}  // namespace skein::flight_model::flight_model_link_test
