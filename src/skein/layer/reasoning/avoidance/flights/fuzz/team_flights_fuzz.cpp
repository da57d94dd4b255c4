// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "skein/base/check.h"
#include "skein/layer/reasoning/avoidance/flights/team_flights.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"

// Whatever bytes a plan report holds: what is taken as a flight is one, and goes out
// again as it came in.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  const std::vector<std::uint8_t> bytes(data, data + size);
  const auto flight = model::decoded_flight(bytes);
  PlanReport report;
  report.number = 1;
  report.flight = bytes;
  const Message message{EntityId{2}, EntityId{1}, 0, Time::from_seconds(1), report};
  reasoning::TeamFlights team;
  team.listen(EntityId{1}, Time::from_seconds(2), {&message, 1});
  const auto* known = team.find(EntityId{2});
  SKEIN_CHECK(known && known->plan.empty() == !flight.has_value());
  if (!flight) return 0;
  SKEIN_CHECK(!flight->empty());
  SKEIN_CHECK(model::end_of(flight->back()).p_N.allFinite());
  SKEIN_CHECK(known->conforms(Time::from_seconds(2)));
  return 0;
}
