#include "layer/reasoning/agent/zone_watch.h"

namespace skein::reasoning {

void ZoneWatch::look(const AgentInput& in, AgentOutput& out) {
  if (guard_.empty()) return;
  const bool inside = guard_.distance(geo::horizontal(in.nav->p_N)) < 0;
  if (inside != inside_)
    out.events.push_back({in.now, self_, "zone",
                          inside ? "is inside a no-flight zone" : "has left the zone"});
  else if (guard_.deflecting() && !deflects_ && !inside)
    out.events.push_back({in.now, self_, "zone", "turns away from a no-flight zone"});
  inside_ = inside;
  deflects_ = guard_.deflecting();
}

}  // namespace skein::reasoning
