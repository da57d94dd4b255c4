// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace skein::flight_model {

/// Datagrams as X-Plane sends them, made from its documentation and not by the code that
/// is tested.
template <class T>
void put(std::string& text, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof value);
}

struct XPlanePosition {
  double longitude_deg = 0, latitude_deg = 0, msl_m = 0;
  float agl_m = 0, pitch_deg = 0, heading_deg = 0, roll_deg = 0;
  float east_mps = 0, up_mps = 0, south_mps = 0;
  float p = 0, q = 0, r = 0;  // [rad/s]
};

inline std::string rpos(const XPlanePosition& at) {
  std::string text = "RPOS4";
  put(text, at.longitude_deg);
  put(text, at.latitude_deg);
  put(text, at.msl_m);
  for (const float value : {at.agl_m, at.pitch_deg, at.heading_deg, at.roll_deg,
                            at.east_mps, at.up_mps, at.south_mps, at.p, at.q, at.r})
    put(text, value);
  return text;
}

inline std::string rref(const std::vector<std::pair<std::int32_t, float>>& values) {
  std::string text = "RREF,";
  for (const auto& [number, value] : values) {
    put(text, number);
    put(text, value);
  }
  return text;
}

}  // namespace skein::flight_model
