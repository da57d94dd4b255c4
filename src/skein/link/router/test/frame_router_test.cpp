// SPDX-License-Identifier: Apache-2.0
#include "skein/link/router/frame_router.h"

#include <gtest/gtest.h>

#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::router::frame_router_test {
namespace {

using Channels = std::vector<Channel>;

// A vehicle (1/1) on channel 1, a ground station (255/190) on 2, another vehicle (2/1)
// with a camera (2/100) on 3.
struct Network {
  FrameRouter router;

  Network() {
    for (const Channel channel : {1U, 2U, 3U}) router.open(channel);
    send(1, 1, 1, mavlink::Heartbeat());
    send(2, 255, 190, mavlink::Heartbeat());
    send(3, 2, 1, mavlink::Heartbeat());
    send(3, 2, 100, mavlink::Heartbeat());
  }

  template <class T>
  Channels send(Channel from, std::uint8_t system, std::uint8_t component,
                const T& message) {
    mavlink::FrameWriter writer(system, component);
    Channels out;
    mavlink::FrameParser().read(writer.write(message), [&](const mavlink::Frame& frame) {
      router.route(from, frame, out);
    });
    return out;
  }

  Channels order(std::uint8_t system, std::uint8_t component) {
    mavlink::CommandLong command;
    command.target_system = system;
    command.target_component = component;
    return send(2, 255, 190, command);
  }
};

TEST(FrameRouter, HandsWhatIsForAllToAllOthers) {
  Network net;
  EXPECT_EQ(net.send(1, 1, 1, mavlink::Attitude()), (Channels{2, 3}));
  EXPECT_EQ(net.order(0, 0), (Channels{1, 3}));
}

TEST(FrameRouter, HandsWhatIsForOneToWhereItWasHeard) {
  Network net;
  EXPECT_EQ(net.order(1, 1), (Channels{1}));
  EXPECT_EQ(net.order(2, 0), (Channels{3}));
  EXPECT_EQ(net.order(2, 100), (Channels{3}));
  EXPECT_EQ(net.order(2, 7), Channels()) << "a component that nobody has heard";
  EXPECT_EQ(net.order(9, 1), Channels()) << "a system that nobody has heard";
  EXPECT_EQ(net.order(255, 190), Channels()) << "not back to where it comes from";
}

TEST(FrameRouter, KnowsASystemOnTwoLinks) {
  Network net;
  net.router.open(4);
  net.send(4, 1, 1, mavlink::Heartbeat());
  EXPECT_EQ(net.order(1, 1), (Channels{1, 4}));
  net.router.close(1);
  EXPECT_EQ(net.order(1, 1), (Channels{4}));
  EXPECT_EQ(net.router.systems_of(4), (std::vector<std::uint8_t>{1}));
}

TEST(FrameRouter, KeepsKeysToItself) {
  Network net;
  mavlink::SetupSigning key;
  key.target_system = 1;
  EXPECT_EQ(net.send(2, 255, 190, key), Channels());
}

TEST(FrameRouter, ForgetsWhereASystemWasThatBeginsAnew) {
  Network net;
  mavlink::SystemTime time;
  time.time_boot_ms = 50'000;
  net.send(1, 1, 1, time);
  time.time_boot_ms = 49'500;  // overtaken on the way
  net.send(3, 1, 1, time);
  EXPECT_EQ(net.order(1, 1), (Channels{1, 3}));
  time.time_boot_ms = 300;
  net.send(3, 1, 1, time);
  EXPECT_EQ(net.order(1, 1), (Channels{3}));
  EXPECT_EQ(net.order(2, 1), (Channels{3})) << "others are not forgotten";
}

TEST(FrameRouter, NobodyIsSystem0) {
  Network net;
  net.send(1, 0, 1, mavlink::Heartbeat());
  EXPECT_EQ(net.router.systems_of(1), (std::vector<std::uint8_t>{1}));
}

}  // namespace
}  // namespace skein::router::frame_router_test
