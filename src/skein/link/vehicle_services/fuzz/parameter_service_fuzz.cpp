// SPDX-License-Identifier: Apache-2.0
// Parameters, whatever ground stations ask and set: values stay within their bounds and
// types, and what is said of them is true.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "skein/link/mavlink/dispatch.h"
#include "skein/link/mavlink/fuzz/message_feed.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/parameter_service.h"

namespace {

using namespace skein;
using namespace skein::vehicle_services;
using mavlink::Frame;
using Feed = mavlink::MessageFeed<mavlink::ParamRequestList, mavlink::ParamRequestRead,
                                  mavlink::ParamSet>;

constexpr std::size_t kMaxListings = 16;  // as the service has
constexpr std::size_t kMaxAtOnce = 26;    // of a list, in a step
constexpr std::uint16_t kNoIndex = 65'535;

// Short names, which a fuzzer finds.
std::vector<Parameter> parameters() {
  std::vector<Parameter> all = {
      {"A", ParameterType::kUint8, 200},
      {"B", ParameterType::kInt8, -100},
      {"C", ParameterType::kUint16, 60'000},
      {"D", ParameterType::kInt16, -300, -1000, 1000},
      {"E", ParameterType::kUint32, 4e9, 0, 5e9},
      {"F", ParameterType::kInt32, -2e9, -3e9, 3e9},
      {"G", ParameterType::kReal32, 0.5, -1e30, 1e30},
      {"H", ParameterType::kReal32, 30, 1, 100},
      {"I", ParameterType::kInt16, 7, 1, 255, true},
      {"SIXTEEN_LETTERS_", ParameterType::kReal32, 1},
  };
  for (int k = 0; k < 30; ++k)
    all.push_back({"P" + std::to_string(k), ParameterType::kReal32, k * 0.5});
  return all;
}

double lowest_of(ParameterType type) {
  switch (type) {
    case ParameterType::kInt8:
      return -128;
    case ParameterType::kInt16:
      return -32'768;
    case ParameterType::kInt32:
      return -2'147'483'648.0;
    case ParameterType::kReal32:
      return -std::numeric_limits<float>::max();
    default:
      return 0;
  }
}
double highest_of(ParameterType type) {
  switch (type) {
    case ParameterType::kUint8:
      return 255;
    case ParameterType::kUint16:
      return 65'535;
    case ParameterType::kUint32:
      return 4'294'967'295.0;
    case ParameterType::kReal32:
      return std::numeric_limits<float>::max();
    default:
      return -1 - lowest_of(type);
  }
}

struct Subject {
  explicit Subject(Feed& from) : feed(from) {}

  void open(Channel) {}
  void close(Channel channel) {
    service.close(channel);
    out.close(channel);
  }

  void receive(const Frame& frame, Channel channel, Time now) {
    const Peer from{channel, frame.system(), frame.component()};
    sent = changes = 0;
    mavlink::dispatch<mavlink::ParamRequestList>(
        frame, [&](const auto& m) { service.handle(m, from, now); });
    const bool is_change = mavlink::dispatch<mavlink::ParamSet>(
        frame, [&](const auto& m) { service.handle(m, from, out); });
    mavlink::dispatch<mavlink::ParamRequestRead>(
        frame, [&](const auto& m) { service.handle(m, from, out); });
    SKEIN_CHECK(sent <= 2 && changes <= (is_change ? 1U : 0U), sent, changes);
    check_values();
  }

  void step(Time now) {
    sent = 0;
    service.step(now, out);
    SKEIN_CHECK(sent <= kMaxListings * kMaxAtOnce, sent);
  }

  // Every list comes to its end, whoever asked for it.
  void end() {
    Time now = feed.now();
    for (std::size_t k = 0; k <= names.size() / (kMaxAtOnce - 1) + 1; ++k)
      step(now += Time::from_seconds(1));
    SKEIN_CHECK(sent == 0, sent);
  }

  // Invariants.
  void check_values() {
    SKEIN_CHECK(service.size() == names.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      Parameter& before = values[i];
      const Parameter& now = *shown[i];
      SKEIN_CHECK(now.value >= std::max(now.lowest, lowest_of(now.type)), now.name);
      SKEIN_CHECK(now.value <= std::min(now.highest, highest_of(now.type)), now.name);
      SKEIN_CHECK(now.type == ParameterType::kReal32 ||
                  now.value == std::round(now.value));
      SKEIN_CHECK(!now.read_only || now.value == before.value, now.name);
      SKEIN_CHECK(now.value == before.value || changed[now.name] == now.value, now.name);
      before.value = now.value;
    }
  }

  void check_sent(Channel channel, std::span<const std::byte> bytes) {
    ++sent;
    SKEIN_CHECK(feed.is_open(channel), channel);
    mavlink::take_sent(bytes, [&](const Frame& frame) {
      const bool known =
          mavlink::dispatch<mavlink::ParamError>(
              frame,
              [&](const auto& m) {
                SKEIN_CHECK(m.param_index < static_cast<int>(names.size()));
              }) ||
          mavlink::dispatch<mavlink::ParamValue>(frame,
                                                 [&](const mavlink::ParamValue& m) {
                                                   is_true(m);
                                                   mavlink::ParamSet change;
                                                   change.target_system = 7;
                                                   change.param_id = m.param_id;
                                                   change.param_value = m.param_value;
                                                   feed.expect(change, channel, 255, 190);
                                                 });
      SKEIN_CHECK(known, frame.message->name);
    });
  }

  void is_true(const mavlink::ParamValue& message) const {
    const Parameter* parameter = service.find(mavlink::text_of(message.param_id));
    SKEIN_CHECK(parameter != nullptr && message.param_count == names.size());
    SKEIN_CHECK(message.param_index == kNoIndex ||
                    names.at(message.param_index) == parameter->name,
                message.param_index);
    SKEIN_CHECK(message.param_type == static_cast<std::uint8_t>(parameter->type));
    const double value =
        decoded_parameter(message.param_value, parameter->type, encoding);
    // A cast to float keeps 24 bits of an integer.
    const double of_float = static_cast<double>(static_cast<float>(parameter->value));
    SKEIN_CHECK(value == parameter->value || value == of_float, parameter->name);
  }

  Feed& feed;
  ParameterEncoding encoding = static_cast<ParameterEncoding>(feed.option() % 2);
  std::vector<Parameter> values = parameters();  // before the last message
  std::vector<std::string> names = [this] {
    std::vector<std::string> all;
    for (const Parameter& parameter : values) all.push_back(parameter.name);
    return all;
  }();
  std::map<std::string, double> changed;  // as the service has reported
  std::size_t changes = 0, sent = 0;      // by the last message or step
  ParameterService service{parameters(), encoding, [this](const Parameter& parameter) {
                             changed[parameter.name] = parameter.value;
                             ++changes;
                           }};
  // Those of the service, by their index.
  std::vector<const Parameter*> shown = [this] {
    std::vector<const Parameter*> all;
    for (const std::string& name : names) all.push_back(service.find(name));
    return all;
  }();
  Outbox out{7, 1, [this](Channel to, auto bytes) { check_sent(to, bytes); }};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Feed feed({data, size}, 7, 1);
  Subject subject(feed);
  feed.run(subject);
  subject.end();
  return 0;
}
