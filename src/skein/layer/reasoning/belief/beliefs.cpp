// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/belief/beliefs.h"

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kTellEvery = 1;  // of one object [s]

}  // namespace

void Beliefs::step(const AgentInput& in, AgentOutput& out) {
  team_.listen(in);
  for (const Message& message : in.inbox)
    if (const auto* sighting = std::get_if<ObjectSighting>(&message.content))
      objects_.add(*sighting);
  if (in.nav)
    for (const SensorSample& sample : in.samples)
      if (const auto* seen = std::get_if<DetectionSample>(&sample))
        see(*seen, *in.nav, out);
  objects_.forget(in.now);
  if (in.nav) traffic_.step(in, team_, out);
}

// Placed by where the aircraft was when the picture was taken.
void Beliefs::see(const DetectionSample& seen, const NavEstimate& nav, AgentOutput& out) {
  const double ago = (nav.time - seen.time).seconds();
  ObjectSighting sighting;
  sighting.object = seen.object;
  sighting.time = seen.time;
  sighting.position =
      geo::horizontal(nav.p_N) - ago * geo::horizontal(nav.v_N) + seen.position;
  sighting.position_sd = math::hypot(seen.position_sd, nav.position_sd);
  sighting.what = seen.what;
  objects_.add(sighting);
  const auto [told, first] = reported_.try_emplace(seen.object, seen.time);
  if (!first && (seen.time - told->second).seconds() < kTellEvery) return;
  told->second = seen.time;
  Message message;
  message.to = station_;
  message.content = sighting;
  out.outbox.push_back(std::move(message));
}

}  // namespace skein::reasoning
