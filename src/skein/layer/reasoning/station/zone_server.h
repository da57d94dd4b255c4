// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skein/data/airspace/zone_set.h"
#include "skein/data/vehicle/agent_step.h"

namespace skein::reasoning {

struct ZoneServerOptions {
  std::vector<EntityId> team;  ///< who has to acknowledge
  std::vector<Zone> known;     ///< in force from the start
  /// Zones that an operator can put into force by name; those known are among them.
  std::vector<Zone> drawn;
  double resend_after = 2;  ///< to an aircraft in contact that has not acknowledged [s]
  double resend_slow = 10;  ///< to one whose link is down [s]
};

/// The part of a ground station that says which no-fly zones are in force.
///
/// Commands (ZoneChange without number) become numbered changes, which go to each
/// aircraft of the team at once. Each AircraftReport acknowledges them up to a number;
/// what is not acknowledged is sent again. So a message that is lost delays a change, and
/// leaves nobody without it.
///
/// Events: "zone-on" and "zone-off", "zone-refused" with the reason, and "zones-known"
/// when all in contact have acknowledged the last change.
class ZoneServer {
 public:
  explicit ZoneServer(const ZoneServerOptions& options);

  /// Takes in reports and commands, and sends what is new or has not been acknowledged.
  /// @param changes  those of this step are appended, for the station's missions.
  void step(const AgentInput& in, std::vector<Message>& changes, AgentOutput& out);

 private:
  struct Listener {
    EntityId id = {};
    std::uint32_t knows = 0;
    Time heard = {}, sent = {};
    bool was_heard = false;
  };
  void take_report(const Message& message, Time now);
  void issue(ZoneChange change, Time now, AgentOutput& out);
  void send_missing(Time now, AgentOutput& out);
  void report_when_known(Time now, AgentOutput& out);

  ZoneServerOptions options_;
  std::map<std::string, Zone> drawn_;
  ZoneSet known_;
  std::vector<ZoneChange> changes_;  // number k at k - 1
  std::vector<Listener> team_;
  bool all_know_ = true;
};

}  // namespace skein::reasoning
