// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/parameter_service.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "skein/link/vehicle_services/test/bad_line.h"

namespace skein::vehicle_services::parameter_service_test {
namespace {

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = {
      {"WP_RADIUS", ParameterType::kReal32, 30, 1, 100},
      {"SYSID_THISMAV", ParameterType::kInt16, 7, 1, 255, true},
      {"RTL_ALT", ParameterType::kInt32, -70'000, -200'000, 200'000},
      {"SIXTEEN_LETTERS_", ParameterType::kUint8, 200},
  };
  for (int k = 0; k < 300; ++k)
    all.push_back({"P" + std::to_string(k), ParameterType::kReal32, k * 0.5});
  return all;
}

struct Vehicle {
  explicit Vehicle(ParameterEncoding encoding = ParameterEncoding::kCast)
      : service(parameters(), encoding,
                [this](const Parameter& p) { changes[p.name] = p.value; }) {}

  void handle(const mavlink::Frame& frame, Time now, Outbox& out) {
    const Peer from = peer_of(frame);
    on<mavlink::ParamRequestList>(frame,
                                  [&](const auto& m) { service.handle(m, from, now); });
    on<mavlink::ParamRequestRead>(frame,
                                  [&](const auto& m) { service.handle(m, from, out); });
    on<mavlink::ParamSet>(frame, [&](const auto& m) { service.handle(m, from, out); });
  }

  std::map<std::string, double> changes;
  ParameterService service;
};

// What a change is answered with.
struct Answer {
  std::map<std::string, float> values;
  std::vector<int> errors;
};

Answer set(Vehicle& vehicle, const std::string& name, float value) {
  Answer answer;
  Outbox out(7, 1, [&](Channel channel, std::span<const std::byte> bytes) {
    EXPECT_EQ(channel, 3U);
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::ParamValue>(frame, [&](const auto& m) {
        answer.values[std::string(mavlink::text_of(m.param_id))] = m.param_value;
        EXPECT_EQ(m.param_index, 65'535);
      });
      on<mavlink::ParamError>(frame,
                              [&](const auto& m) { answer.errors.push_back(m.error); });
    });
  });
  mavlink::ParamSet change;
  mavlink::set_text(change.param_id, name);
  change.param_value = value;
  vehicle.service.handle(change, {3, 255, 190}, out);
  return answer;
}

TEST(ParameterService, ListsAllOverEveryLine) {
  for (const Trouble& trouble : troubles()) {
    SCOPED_TRACE(testing::Message() << "loss " << trouble.loss);
    BadLine line(trouble, 5);
    Vehicle vehicle;
    line.at_vehicle = [&](const auto& f) { vehicle.handle(f, line.now, line.vehicle); };
    std::map<int, std::string> heard;
    std::size_t count = 0;
    line.at_station = [&](const mavlink::Frame& frame) {
      on<mavlink::ParamValue>(frame, [&](const auto& m) {
        heard[m.param_index] = mavlink::text_of(m.param_id);
        count = m.param_count;
      });
    };
    // As ground stations do: the list, then what is missing by index, ten at a time.
    const auto expected = parameters();
    for (int k = 0; k < 12'000 && heard.size() < expected.size(); ++k) {
      if (k % 300 == 0 && heard.empty())
        line.station.send(1, mavlink::ParamRequestList());
      if (k % 300 == 299 && !heard.empty())
        for (int i = 0, asked = 0; i < int(count) && asked < 10; ++i)
          if (!heard.contains(i)) {
            mavlink::ParamRequestRead request;
            request.param_index = static_cast<std::int16_t>(i);
            line.station.send(1, request);
            ++asked;
          }
      vehicle.service.step(line.now, line.vehicle);
      line.step();
    }
    ASSERT_EQ(heard.size(), expected.size());
    EXPECT_EQ(count, expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ(heard.at(static_cast<int>(i)), expected[i].name);
  }
}

TEST(ParameterService, KeepsAChangeWithinItsBounds) {
  Vehicle vehicle;
  EXPECT_EQ(set(vehicle, "WP_RADIUS", 45).values.at("WP_RADIUS"), 45);
  EXPECT_EQ(vehicle.changes.at("WP_RADIUS"), 45);
  EXPECT_EQ(set(vehicle, "WP_RADIUS", 1000).values.at("WP_RADIUS"), 100);
  EXPECT_EQ(set(vehicle, "RTL_ALT", 12.4F).values.at("RTL_ALT"), 12);
}

TEST(ParameterService, RefusesWhatCannotBeSet) {
  Vehicle vehicle;
  const Answer nan = set(vehicle, "WP_RADIUS", std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(nan.errors, (std::vector<int>{2}));
  EXPECT_EQ(nan.values.at("WP_RADIUS"), 30);
  const Answer fixed = set(vehicle, "SYSID_THISMAV", 9);
  EXPECT_EQ(fixed.errors, (std::vector<int>{5}));
  EXPECT_EQ(fixed.values.at("SYSID_THISMAV"), 7);
  const Answer unknown = set(vehicle, "NO_SUCH", 1);
  EXPECT_EQ(unknown.errors, (std::vector<int>{1}));
  EXPECT_TRUE(unknown.values.empty());
  EXPECT_TRUE(vehicle.changes.empty());
}

TEST(ParameterService, IsChangedFromInsideToo) {
  Vehicle vehicle;
  EXPECT_TRUE(vehicle.service.set("WP_RADIUS", 55));
  EXPECT_EQ(vehicle.changes.at("WP_RADIUS"), 55);
  EXPECT_FALSE(vehicle.service.set("SYSID_THISMAV", 9));
  EXPECT_FALSE(vehicle.service.set("NO_SUCH", 9));
  EXPECT_EQ(vehicle.changes.size(), 1U);
}

TEST(ParameterService, CarriesIntegersAsTheIdentityAsks) {
  using enum ParameterType;
  for (const auto& [type, value] : {std::pair{kUint8, 200.0},
                                    {kInt8, -5.0},
                                    {kUint16, 60'000.0},
                                    {kInt16, -300.0},
                                    {kUint32, 4e9},
                                    {kInt32, -2e9},
                                    {kReal32, 0.5}}) {
    for (const auto encoding : {ParameterEncoding::kBytes, ParameterEncoding::kCast})
      EXPECT_EQ(decoded_parameter(coded_parameter(value, type, encoding), type, encoding),
                value)
          << int(type);
  }
  EXPECT_EQ(coded_parameter(-300, kInt16, ParameterEncoding::kCast), -300.0F);
  EXPECT_NE(coded_parameter(-300, kInt16, ParameterEncoding::kBytes), -300.0F);
}

TEST(ParameterService, SendsAListToSeveralAndNotTooFast) {
  Vehicle vehicle;
  std::map<Channel, int> sent;
  Outbox out(7, 1, [&](Channel channel, std::span<const std::byte>) { ++sent[channel]; });
  for (const Channel channel : {1U, 2U})
    vehicle.service.handle(mavlink::ParamRequestList(), {channel, 255, 190}, Time());
  vehicle.service.handle(mavlink::ParamRequestList(), {1, 255, 190}, Time());
  for (int k = 0; k <= 50; ++k) vehicle.service.step(Time::from_seconds(k * 0.01), out);
  EXPECT_EQ(sent.at(1), 126);
  EXPECT_EQ(sent.at(2), 126);
  // After a long wait no more than of a tenth of a second at once.
  vehicle.service.step(Time::from_seconds(10), out);
  EXPECT_EQ(sent.at(1), 126 + 26);
  vehicle.service.close(2);
  for (int k = 0; k <= 500; ++k)
    vehicle.service.step(Time::from_seconds(10 + k * 0.01), out);
  EXPECT_EQ(sent.at(2), 126 + 26) << "that link is gone";
  EXPECT_EQ(sent.at(1), int(parameters().size()))
      << "once, although it was asked for twice";
}

}  // namespace
}  // namespace skein::vehicle_services::parameter_service_test
