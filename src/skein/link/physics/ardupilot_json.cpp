// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_json.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace skein::physics {
namespace {

constexpr std::uint16_t kMagic16 = 18'458, kMagic32 = 29'569;
constexpr std::size_t kServoHeader = 8;  // magic, rate and count [bytes]

template <class T>
T number_at(std::span<const std::byte> bytes, std::size_t place) {
  T value;  // both sides are little-endian, see mavlink/payload.h
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

Error bad_datagram(const std::string& why) {
  return {ErrorCode::kBadInput, "", why, ""};
}

// Appends names and values; remembers what cannot be said.
class LineWriter {
 public:
  explicit LineWriter(std::string& text) : text_(text) {}

  void add(std::string_view raw) { text_ += raw; }
  void add(const char* name, double value) {
    begin(name);
    number(name, value);
  }
  template <class... Numbers>
  void add_list(const char* name, Numbers... values) {
    begin(name);
    const char* before = "[";
    ((text_ += before, number(name, values), before = ","), ...);
    text_ += ']';
  }
  void add(const char* name, const Vec3& v) { add_list(name, v.x(), v.y(), v.z()); }
  void add(const char* name, Time time) {
    begin(name);
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t ns = time.ns();
    fmt::format_to(std::back_inserter(text_), "{}{}.{:09}", ns < 0 ? "-" : "",
                   std::abs(ns / kSecond), std::abs(ns % kSecond));
  }

  const char* not_finite() const { return not_finite_; }

 private:
  void begin(const char* name) {
    if (text_.back() != '{') text_ += ',';
    fmt::format_to(std::back_inserter(text_), "\"{}\":", name);
  }
  void number(const char* name, double value) {
    if (!std::isfinite(value)) not_finite_ = name;
    fmt::format_to(std::back_inserter(text_), "{}", value);
  }

  std::string& text_;
  const char* not_finite_ = nullptr;
};

}  // namespace

Result<ServoFrame> parse_servo_frame(std::span<const std::byte> datagram) {
  if (datagram.size() < kServoHeader)
    return bad_datagram(
        fmt::format("a datagram of {} bytes is too short.", datagram.size()));
  ServoFrame frame;
  const auto magic = number_at<std::uint16_t>(datagram, 0);
  if (magic == kMagic16)
    frame.channels = 16;
  else if (magic == kMagic32)
    frame.channels = 32;
  else
    return bad_datagram(fmt::format("the magic number {} is neither {} nor {}.", magic,
                                    kMagic16, kMagic32));
  if (datagram.size() != kServoHeader + 2 * frame.channels)
    return bad_datagram(fmt::format("a datagram of {} channels has {} bytes, not {}.",
                                    frame.channels, kServoHeader + 2 * frame.channels,
                                    datagram.size()));
  frame.frame_rate_hz = number_at<std::uint16_t>(datagram, 2);
  frame.frame_count = number_at<std::uint32_t>(datagram, 4);
  for (std::size_t k = 0; k < frame.channels; ++k)
    frame.pwm_us[k] = number_at<std::uint16_t>(datagram, kServoHeader + 2 * k);
  return frame;
}

Result<void> write_json(const PhysicsFrame& frame, std::string& text) {
  text = "\n{";
  LineWriter line(text);
  line.add("timestamp", frame.time);
  line.add(",\"imu\":{");
  line.add("gyro", frame.w_NB_B);
  line.add("accel_body", frame.f_B);
  line.add("}");
  line.add("position", frame.p_N);
  line.add_list("quaternion", frame.q_NB.w(), frame.q_NB.x(), frame.q_NB.y(),
                frame.q_NB.z());
  line.add("velocity", frame.v_N);
  if (frame.range) line.add("rng_1", *frame.range);
  line.add("airspeed", frame.airspeed);
  if (frame.paced_by_sender) line.add(",\"no_time_sync\":1");
  if (frame.battery) {
    line.add(",\"battery\":{");
    line.add("voltage", frame.battery->voltage);
    line.add("current", frame.battery->current);
    line.add("}");
  }
  line.add("}\n");
  if (line.not_finite())
    return Error{ErrorCode::kBadInput, line.not_finite(), "a number is not finite.", ""};
  return {};
}

ServoStep ServoFollower::take(std::uint32_t frame_count) {
  if (frame_count == last_) return ServoStep::kRepeat;
  // The count goes round after 2^32.
  const bool goes_on = last_ && (frame_count > *last_ || frame_count == *last_ + 1);
  if (goes_on) missed_ += frame_count - *last_ - 1;
  last_ = frame_count;
  return goes_on ? ServoStep::kNext : ServoStep::kBegin;
}

}  // namespace skein::physics
