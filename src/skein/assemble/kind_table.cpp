#include "skein/assemble/kinds_of.h"
#include "skein/assemble/planner_kinds.h"

namespace skein::assemble {

scenario::KindTable kind_table() {
  scenario::KindTable table;
  terrain_kinds().describe(table);
  wind_kinds().describe(table);
  turbulence_kinds().describe(table);
  fire_kinds().describe(table);
  plant_kinds().describe(table);
  autopilot_kinds().describe(table);
  sensor_kinds().describe(table);
  agent_kinds().describe(table);
  station_agent_kinds().describe(table);
  radio_kinds().describe(table);
  estimator_kinds().describe(table);
  strategy_kinds().describe(table);
  planner_kinds().describe(table);
  return table;
}

}  // namespace skein::assemble
