// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/reasoning/task/planned_task.h"
#include "skein/layer/reasoning/task/survey/survey_lines.h"

namespace skein::reasoning {

/// Flies the lines of a survey in their order; when it is given none it plans them for
/// its area from where it is, in the wind as it then is (solve::plan_coverage).
///
/// A line counts as seen when it was flown from its begin to its end, no further aside
/// than the overlap of its neighbours allows, a tenth of the swath at least; else it is
/// flown once more at the end, and given up when that fails too. What lies in no-fly
/// zones is put aside, and comes back with the zone's end. When nothing else is left the
/// survey is done, with an event "survey-incomplete" that says how much was not flown,
/// and why.
class SurveyTask final : public PlannedTask {
 public:
  SurveyTask(const FlightContext& context, const Survey& order);

  void listen(const TaskStep& step) override;
  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return version_; }
  void interrupt() override;

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  void pass(const TaskStep& step) override;
  bool finish(const TaskStep& step, AgentOutput& out) override;
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  static FlightPlan lead_to(const SurveyLine& line, const FlightState& from,
                            const Start& start, double now);
  bool plan_lines(const Start& start, const TaskStep& step, std::string& why_not);
  bool zones_changed(const TaskStep& step);
  std::vector<Zone> grown_zones(const TaskStep& step) const;
  bool cut_line();

  Survey order_;
  double aside_;  // of a line, still seen [m]
  std::optional<SurveyLines> lines_;
  std::vector<Zone> zones_;  // that count
  bool on_line_ = false;     // between begin and end of the first line that is left
  double farthest_ = 0;      // from it, so far [m]
  double reach_ = 0;         // of an end of a line that counts as flown over [m]
  bool began_ = false;       // the line, at its begin
  Vec2 here_ = Vec2::Zero();
  std::uint32_t version_ = 0;
};

}  // namespace skein::reasoning
