// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/sensor_kinds.h"

namespace skein::assemble {

Kinds<Sensor, AircraftContext> sensor_kinds() {
  Kinds<Sensor, AircraftContext> kinds("sensor");
  add_simple_sensors(kinds);
  add_flight_sensors(kinds);
  add_payload_sensors(kinds);
  add_traffic_sensors(kinds);
  return kinds;
}

}  // namespace skein::assemble
