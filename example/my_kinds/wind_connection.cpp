// SPDX-License-Identifier: Apache-2.0
// A program of one's own with Skein's library: the quickest flight between two poses in
// winds of growing speed.
#include <cstdio>

#include "skein/model/connection/connection.h"

int main() {
  const skein::model::Pose from{{0, 0}, skein::geo::radians(90)};
  const skein::model::Pose to{{600, 400}, 0};
  for (const double speed : {0.0, 4.0, 8.0, 12.0}) {
    skein::model::AirMotion air;
    air.airspeed = 15;
    air.turn_radius = 60;
    air.wind = {0, speed};  // from the west
    const skein::model::Connection found = skein::model::connect(from, to, air);
    if (found.status != skein::model::ConnectionStatus::kFound) return 1;
    std::printf("wind %4.1f m/s: %6.2f s\n", speed, found.time);
  }
  return 0;
}
