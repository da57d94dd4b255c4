// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/traffic_message.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/link/autopilot_client/request_steps.h"
#include "skein/link/mavlink/payload.h"

namespace skein::vehicle_links {
namespace {

constexpr std::uint8_t kGeometric = 1;  // ADSB_ALTITUDE_TYPE
constexpr std::uint8_t kUncrewed = 14;  // ADSB_EMITTER_TYPE
constexpr std::size_t kMaxCallsign = 8;
constexpr double kMinCourseSpeed = 0.5;  // below it there is no course [m/s]

enum : std::uint16_t {  // ADSB_FLAGS
  kValidPlace = 1,
  kValidAltitude = 2,
  kValidHeading = 4,
  kValidVelocity = 8,
  kValidCallsign = 16,
  kSimulated = 64,
  kValidVerticalVelocity = 128,
};

// A number that the field can hold, the nearest one.
template <class T>
T fitted(double value) {
  constexpr double kLow = std::numeric_limits<T>::lowest();
  constexpr double kHigh = std::numeric_limits<T>::max();
  return static_cast<T>(std::lround(std::clamp(value, kLow, kHigh)));
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::uint32_t icao_address(std::string_view name) {
  constexpr std::uint32_t kFirst = 0xf80000, kCount = 0x7ffff;
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : name) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3;
  }
  return kFirst + static_cast<std::uint32_t>((hash ^ hash >> 32) % kCount);
}

std::string callsign(std::string_view name) {
  std::string all;
  for (const char c : name) {
    if (is_digit(c) || (c >= 'A' && c <= 'Z')) all += c;
    if (c >= 'a' && c <= 'z') all += static_cast<char>(c - 'a' + 'A');
  }
  if (all.size() <= kMaxCallsign) return all;
  // The number at its end tells it from others.
  const auto end = std::find_if_not(all.rbegin(), all.rend(), is_digit);
  const auto digits =
      std::min(static_cast<std::size_t>(end - all.rbegin()), kMaxCallsign);
  return all.substr(0, kMaxCallsign - digits) + all.substr(all.size() - digits);
}

mavlink::AdsbVehicle coded(const TrafficIdentity& who, const TrafficState& state,
                           Time now, const geo::LocalFrame& frame) {
  const autopilot_client::ScaledPlace place =
      autopilot_client::scaled_place(geo::horizontal(state.p_N), frame);
  const Vec2 v = geo::horizontal(state.v_N);
  mavlink::AdsbVehicle m;
  m.ICAO_address = who.icao_address;
  m.lat = place.latitude;
  m.lon = place.longitude;
  m.altitude_type = kGeometric;
  m.altitude = fitted<std::int32_t>(-state.p_N.z() * 1000);
  m.hor_velocity = fitted<std::uint16_t>(v.norm() * 100);
  m.ver_velocity = fitted<std::int16_t>(-state.v_N.z() * 100);
  mavlink::set_text(m.callsign, who.callsign);
  m.emitter_type = kUncrewed;
  m.tslc =
      static_cast<std::uint8_t>(std::clamp((now - state.time).seconds(), 0.0, 255.0));
  m.flags = kValidPlace | kValidAltitude | kValidVelocity | kValidVerticalVelocity;
  if (v.norm() >= kMinCourseSpeed) {
    const double course = geo::degrees(geo::wrap_2pi(geo::bearing(v)));
    m.heading = static_cast<std::uint16_t>(std::lround(course * 100) % 36'000);
    m.flags |= kValidHeading;
  }
  if (!who.callsign.empty()) m.flags |= kValidCallsign;
  if (who.is_simulated) m.flags |= kSimulated;
  return m;
}

}  // namespace skein::vehicle_links
