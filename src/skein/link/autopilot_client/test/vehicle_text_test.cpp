// SPDX-License-Identifier: Apache-2.0
// What vehicles say in words, whatever bytes it is made of.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "skein/base/random.h"
#include "skein/base/valid_text.h"
#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/vehicle_services/test/paper_vehicle.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::autopilot_client {
namespace {

// A vehicle that only talks, and what is reported of it.
class Talker {
 public:
  Talker() {
    client_.open(1);
    mavlink::Heartbeat quad;
    quad.type = 2;
    quad.autopilot = 3;
    quad.base_mode = 81;
    quad.system_status = 3;
    vehicle_.send(1, quad);
  }

  void say(const std::string& bytes, std::uint16_t id = 0, std::uint8_t part = 0) {
    mavlink::Statustext message;
    message.severity = 2;
    message.id = id;
    message.chunk_seq = part;
    mavlink::set_text(message.text, bytes);
    vehicle_.send(1, message);
  }
  std::vector<std::string> reported() {
    std::vector<std::string> texts;
    for (const VehicleReport& report : client_.take_reports())
      if (const auto* text = std::get_if<VehicleText>(&report))
        texts.push_back(text->text);
    return texts;
  }

 private:
  geo::LocalFrame frame_ = vehicle_services::test_frame();
  AutopilotClient client_{{.system = 7, .hovers = true}, frame_};
  vehicle_services::Outbox station_{245, 190, [](auto, auto) {}};
  vehicle_services::Outbox vehicle_{7, 1, [this](auto, auto bytes) {
                                      mavlink::FrameParser().read(
                                          bytes, [this](const mavlink::Frame& heard) {
                                            client_.receive(heard, 1, Time(), station_);
                                          });
                                    }};
};

TEST(VehicleText, BytesThatAreNoTextAreReplaced) {
  Talker vehicle;
  vehicle.say("Motor \xff\xfe\xb0 fail");
  EXPECT_EQ(vehicle.reported(),
            std::vector<std::string>{"Motor \uFFFD\uFFFD\uFFFD fail"});
}

TEST(VehicleText, ACharacterMayBeginInOnePartAndEndInTheNext) {
  Talker vehicle;
  vehicle.say(std::string(49, 'x') + "\xC2", 5, 0);
  vehicle.say("\xB5 of it", 5, 1);
  EXPECT_EQ(vehicle.reported(),
            std::vector<std::string>{std::string(49, 'x') + "\u00B5 of it"});
}

TEST(VehicleText, IsValidWhateverIsSaid) {
  Talker vehicle;
  RandomStream random(38, 1, Purpose::kTest);
  for (int run = 0; run < 2000; ++run) {
    std::string bytes(random.bits() % 51, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.bits() % 256);
    vehicle.say(bytes, static_cast<std::uint16_t>(random.bits() % 3),
                static_cast<std::uint8_t>(random.bits() % 4));
    for (const std::string& text : vehicle.reported()) ASSERT_TRUE(is_valid_text(text));
  }
}

}  // namespace
}  // namespace skein::autopilot_client
