// SPDX-License-Identifier: Apache-2.0
// Datagrams of any bytes, one after the other, and what follows from their states: those
// are such as can be, times do not run away, and each is counted.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "skein/base/check.h"
#include "skein/link/flight_model/state_follower.h"
#include "skein/link/flight_model/x_plane.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  using namespace skein::flight_model;
  static const geo::LocalFrame frame = geo::LocalFrame::at({37, -122, 0}).value();
  XPlaneReader reader;
  StateFollower follower(frame);
  std::uint64_t states = 0;
  // Pieces that begin with their length.
  for (std::size_t at = 0; at < size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 1);
    const auto state = reader.read(std::as_bytes(std::span(data + at + 1, length)));
    at += 1 + length;
    if (!state) continue;
    SKEIN_CHECK(check(*state).ok());
    const Time came = Time::from_seconds(static_cast<double>(++states));
    std::vector<VehicleReport> out;
    follower.take(*state, came, out);
    for (const VehicleReport& report : out)
      if (const auto* motion = std::get_if<VehicleMotion>(&report)) {
        SKEIN_CHECK(motion->p_N.allFinite());
        SKEIN_CHECK(std::abs((motion->time - came).seconds()) <= 0.26);
      }
  }
  SKEIN_CHECK(reader.counts().states == states);
  return 0;
}
