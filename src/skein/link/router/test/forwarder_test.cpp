// SPDX-License-Identifier: Apache-2.0
// Frames over real sockets.
#include "skein/link/router/forwarder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::router::forwarder_test {
namespace {

using namespace std::chrono_literals;

// A program at the other end of a link.
class Program final : public transport::ChannelListener {
 public:
  explicit Program(const std::string& endpoint) {
    EXPECT_TRUE(endpoints.open(transport::parse_endpoint(endpoint).value()).ok());
  }
  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    channels.push_back(channel);
  }
  void received(transport::ChannelId, std::span<const std::byte> bytes) override {
    parser.read(bytes, [&](const mavlink::Frame& frame) {
      ids.push_back(frame.id());
      last.assign(frame.bytes.begin(), frame.bytes.end());
    });
  }
  void closed(transport::ChannelId channel, const std::string&) override {
    std::erase(channels, channel);
  }
  void send(std::span<const std::byte> bytes) {
    for (const auto channel : channels) endpoints.send(channel, bytes);
  }

  std::vector<transport::ChannelId> channels;
  std::vector<std::uint32_t> ids;
  std::vector<std::byte> last;
  mavlink::FrameParser parser;
  transport::Endpoints endpoints{*this};
};

struct Network {
  std::vector<std::string> news;
  Forwarder forwarder{[] { return std::int64_t{1'700'000'000'000'000}; },
                      [this](const std::string& text) { news.push_back(text); }};

  // The place at which another server of the forwarder waits, for a client.
  std::string serve(const std::string& server, const std::string& client) {
    const auto opened =
        forwarder.endpoints().open(transport::parse_endpoint(server).value());
    EXPECT_TRUE(opened.ok());
    const std::string at = forwarder.endpoints().places().back();
    return client + at.substr(at.find(':'));
  }
  bool wait(std::initializer_list<Program*> programs,
            const std::function<bool()>& until) {
    for (int k = 0; k < 1000 && !until(); ++k) {
      forwarder.endpoints().run_for(3ms);
      for (Program* program : programs) program->endpoints.run_for(3ms);
    }
    return until();
  }
};

TEST(Forwarder, HandsFramesOnBetweenDatagramsAndConnections) {
  Network net;
  Program vehicle(net.serve("udpin:0", "udpout")), station(net.serve("tcpin:0", "tcp"));
  ASSERT_TRUE(net.wait({&vehicle, &station}, [&] { return !station.channels.empty(); }));

  mavlink::FrameWriter of_vehicle(7, 1), of_station(255, 190);
  vehicle.send(of_vehicle.write(mavlink::Heartbeat()));
  ASSERT_TRUE(net.wait({&vehicle, &station}, [&] { return !station.ids.empty(); }));
  EXPECT_EQ(station.ids, (std::vector<std::uint32_t>{0}));

  // A signed command goes back byte for byte.
  mavlink::Signer signer(mavlink::key_of("key"), 1, 0);
  mavlink::CommandLong command;
  command.target_system = 7;
  const auto sent = of_station.write(command, signer, 5);
  station.send(sent);
  ASSERT_TRUE(net.wait({&vehicle, &station}, [&] { return !vehicle.ids.empty(); }));
  EXPECT_EQ(vehicle.last, std::vector<std::byte>(sent.begin(), sent.end()));

  // For a system that is not there it goes nowhere.
  command.target_system = 8;
  station.send(of_station.write(command));
  ASSERT_TRUE(net.wait({&station}, [&] {
    std::uint64_t in = 0;
    for (const ChannelHealth& health : net.forwarder.health()) in += health.in.frames;
    return in == 3;
  }));
  const auto health = net.forwarder.health();
  ASSERT_EQ(health.size(), 2U);
  EXPECT_EQ(health[0].out + health[1].out, 2U);
  EXPECT_EQ(net.news.size(), 2U);
}

TEST(Forwarder, KeepsTheHealthOfALinkThatIsGone) {
  Network net;
  {
    Program station(net.serve("tcpin:0", "tcp"));
    ASSERT_TRUE(net.wait({&station}, [&] { return !station.channels.empty(); }));
    std::vector<std::byte> bytes(5, std::byte{1});  // rubbish before the frame
    mavlink::FrameWriter writer(255, 190);
    const auto frame = writer.write(mavlink::Heartbeat());
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    station.send(bytes);
    ASSERT_TRUE(net.wait({&station}, [&] {
      const auto health = net.forwarder.health();
      return !health.empty() && health[0].in.frames == 1;
    }));
  }
  ASSERT_TRUE(net.wait({}, [&] { return !net.forwarder.health()[0].open; }));
  const ChannelHealth gone = net.forwarder.health()[0];
  EXPECT_EQ(gone.in.skipped_bytes, 5U);
  EXPECT_EQ(gone.systems, (std::vector<std::uint8_t>{255}));
  EXPECT_EQ(net.news.size(), 2U);
}

TEST(Forwarder, RecordsWhatComesInButNoKeys) {
  Network net;
  const auto file = std::filesystem::path(testing::TempDir()) / "skein-forwarder.tlog";
  net.forwarder.record_to(std::move(mavlink::TlogWriter::create(file).value()));
  Program vehicle(net.serve("udpin:0", "udpout"));
  mavlink::FrameWriter writer(7, 1);
  const std::size_t length = writer.write(mavlink::Heartbeat()).size();
  vehicle.send(writer.write(mavlink::SetupSigning()));
  vehicle.send(writer.write(mavlink::Heartbeat()));
  ASSERT_TRUE(net.wait({&vehicle}, [&] {
    const auto health = net.forwarder.health();
    return !health.empty() && health[0].in.frames == 2;
  }));
  ASSERT_TRUE(net.forwarder.flush().ok());
  EXPECT_EQ(std::filesystem::file_size(file), 8 + length);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace skein::router::forwarder_test
