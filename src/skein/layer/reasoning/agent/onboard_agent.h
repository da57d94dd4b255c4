// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "skein/layer/reasoning/agent/fire_readings.h"
#include "skein/layer/reasoning/agent/flight_safety.h"
#include "skein/layer/reasoning/agent/loiter_planner.h"
#include "skein/layer/reasoning/agent/planner_chain.h"
#include "skein/layer/reasoning/agent/report_rate.h"
#include "skein/layer/reasoning/agent/status_report.h"
#include "skein/layer/reasoning/agent/task_planner.h"
#include "skein/layer/reasoning/avoidance/alerting/traffic_alerting.h"
#include "skein/layer/reasoning/team/onboard/onboard_team.h"
#include "skein/role/agent.h"

namespace skein::reasoning {

struct OnboardAgentOptions {
  double report_period = 1;  ///< between reports to the station [s]
  ReportRateOptions report_rate = {};
  SafetyZone safety_zone = {};
  ZoneAvoidanceOptions avoidance = {};
  SeparationOptions separation = {};
  /// A pilot on board flies and is shown what keeps apart from others; none: it is flown.
  std::optional<AdvisedPilotOptions> pilot = {};
  std::optional<TaskKind> first_task = {};  ///< until an order comes
  bool takes_orders = true;
  /// Of the team, who finds other aircraft: they are told with each report where it is.
  std::vector<EntityId> watchers = {};
  /// It is a member of a team that leads itself, which gives it tasks; none: it is not.
  std::optional<OnboardTeamOptions> team = {};
};

/// The agent on board of an aircraft, whatever its task.
///
/// It flies the newest task it has received (TaskPlanner) by a chain of planners that
/// always have something to fly (PlannerChain); without messages it goes on with the last
/// task, and before the first it circles where it began. It sends the readings of its
/// fire sensor and a report each second to the station, fewer where the air is full
/// (ReportRate). It takes off first, as long as no no-fly zone forbids it (FlightSafety).
///
/// As a member of a team that leads itself it flies what that gives it (OnboardTeam), by
/// the same executors; an order of the station goes before.
class OnboardAgent final : public Agent {
 public:
  /// @param station  who gets its reports.
  /// @param zones    no-fly zones in force from the start, copied.
  /// @param make     makes the executors of tasks.
  OnboardAgent(const OnboardAgentOptions& options, EntityId station,
               const FlightContext& context, std::span<const Zone> zones, MakeTask make);

  void step(const AgentInput& in, AgentOutput& out) override;

  /// Of the newest order that it has received; 0: none.
  std::uint32_t task_number() const { return tasks_.order(); }
  bool task_done() const { return tasks_.state() == TaskState::kDone; }

 private:
  void follow_team(const AgentInput& in, AgentOutput& out);
  bool fly(const TaskStep& step, AgentOutput& out);  // whether it flies
  void look_out(const TaskStep& step, bool flies, AgentOutput& out);
  void tell_watchers(const NavEstimate& nav, AgentOutput& out) const;
  double altitude_to_take_off_to(const NavEstimate& nav) const;

  OnboardAgentOptions options_;
  FlightContext context_;  // height and speed as last ordered
  FlightSafety safety_;
  Beliefs beliefs_;
  ReportRate rate_;
  FireReadings readings_;
  StatusReport report_;
  TaskPlanner tasks_;
  std::unique_ptr<OnboardTeam> team_;  // null: none
  LoiterPlanner loiter_;
  PlannerChain chain_;
  TrafficAlerting alerting_;
  IntentCounter intents_;
  bool gazes_ = false;  // the gimbals look at something
};

}  // namespace skein::reasoning
