#pragma once

#include <optional>
#include <vector>

#include "skein/data/task.h"
#include "skein/role/mission.h"

namespace skein::reasoning {

/// From `at` on, the team's aircraft `leader` leads.
struct Leadership {
  Time at;
  std::size_t leader = 0;  ///< index in the team
};

struct FormationOptions {
  std::vector<EntityId> team;
  std::vector<Vec2> route;  ///< flown by the leader [m]
  int laps = 1000;
  /// Slots ahead of the leader and to its right [m]; the followers take them in the order
  /// of the team.
  std::vector<Vec2> slots;
  std::vector<Leadership> leaders;  ///< in order of time; the first at 0
  /// The leader reports its position to its followers; else the station passes it on.
  bool direct = false;
};

/// A flight in formation: says who leads and who follows, again until it is confirmed.
/// The followers hear of the leader's position from itself or from the station.
class FormationControl final : public Mission {
 public:
  explicit FormationControl(const FormationOptions& options);

  void step(const AgentInput& in, AgentOutput& out) override;
  MissionDemand demand() const override;

 private:
  struct Member {
    Task task;
    Time sent;
    std::uint32_t confirmed = 0;
  };
  void appoint(std::size_t leader, Time now, AgentOutput& out);
  void send(std::size_t k, Time now, AgentOutput& out);

  FormationOptions options_;
  std::vector<Member> members_;  // as options_.team
  std::optional<std::size_t> leader_;
  std::size_t next_ = 0;  // of options_.leaders
};

}  // namespace skein::reasoning
