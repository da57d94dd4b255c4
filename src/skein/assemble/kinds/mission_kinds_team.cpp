// SPDX-License-Identifier: Apache-2.0
// Missions that give each aircraft one task after the other: one row each.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/assemble/kinds/mission_fields.h"
#include "skein/assemble/kinds/mission_kinds.h"
#include "skein/data/team/task_text.h"
#include "skein/layer/reasoning/mission/delegated/delegated_mission.h"
#include "skein/layer/reasoning/mission/patrol/patrol_mission.h"
#include "skein/layer/reasoning/mission/survey/survey_mission.h"
#include "skein/layer/reasoning/mission/tasks/task_mission.h"
#include "skein/layer/reasoning/mission/track/track_mission.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::assemble {
namespace {

using namespace reasoning;
using scenario::Fields;
using MadeTeam = Result<std::unique_ptr<PlannedMission>>;

struct SurveyChoice : MissionSchedule {
  geo::Ring area = {{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
  std::vector<geo::Ring> holes;
  double swath = 100, overlap = 0.1;
  std::optional<double> bearing;
  double zone_margin = 35;
};

Fields<SurveyChoice> survey_fields() {
  using T = SurveyChoice;
  return with_schedule(
      Fields<T>()
          .polygon("area_m", &T::area, "To be seen: its corners.")
          .polygon("holes_m", &T::holes,
                   "Areas within that need not be seen and may be flown over.")
          .items({.at_most = 1000})
          .number("swath_m", &T::swath, "Width that is seen, half on either side.",
                  {.above = 0, .at_most = 1e5})
          .number("overlap", &T::overlap,
                  "Share of it that neighbouring lines have in common.",
                  {.at_least = 0, .at_most = 0.95})
          .angle_deg("bearing_deg", &T::bearing,
                     "Of the lines. Null: the one that is done first.",
                     {.at_least = -360, .at_most = 360})
          .number("zone_margin_m", &T::zone_margin, "Kept by lines from no-fly zones.",
                  {.at_least = 0, .at_most = 1e4}));
}

MadeTeam make_survey(const SurveyChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  SurveyMissionOptions options;
  options.survey.area = choice.area;
  options.survey.holes = choice.holes;
  options.survey.swath = choice.swath;
  options.survey.overlap = choice.overlap;
  options.bearing = choice.bearing;
  options.zones = c.zones;
  options.zone_margin = choice.zone_margin;
  options.planner = c.planner;
  if (std::string error = task_error(options.survey); !error.empty())
    return Error{ErrorCode::kBadInput, "area_m", std::move(error), ""};
  return planned(
      "survey", choice, who.value(),
      std::make_unique<SurveyMission>(who.value().candidates, std::move(options)));
}

struct TrackChoice : MissionSchedule {
  TrackChoice() { needs_camera = true, priority = 1; }
  std::vector<std::string> objects;
  double radius = 0;
  bool weave = false;
  Time lost_after = Time::from_seconds(120);
};

Fields<TrackChoice> track_fields() {
  using T = TrackChoice;
  return with_schedule(
      Fields<T>()
          .text("objects", &T::objects,
                "Names of objects of the environment that are kept in view. Empty: all "
                "that anybody sees.")
          .items({.at_most = 10000})
          .number("radius_m", &T::radius,
                  "Of the circles around them. 0: as small as the aircraft can.",
                  {.at_least = 0, .at_most = 1e5})
          .boolean("weave", &T::weave, "S-turns along their tracks instead of circles.")
          .duration_s("lost_after_s", &T::lost_after,
                      "One that nobody has seen for so long is given up.", {.above = 0}));
}

MadeTeam make_track(const TrackChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  TrackMissionOptions options;
  options.radius = choice.radius;
  options.weave = choice.weave;
  options.lost_after = choice.lost_after.seconds();
  options.record_period = c.metrics_period;
  for (const std::string& name : choice.objects) {
    const auto found = std::find(c.objects.begin(), c.objects.end(), name);
    if (found == c.objects.end())
      return Error{ErrorCode::kBadInput, "objects",
                   fmt::format("the environment has no object \"{}\".", name), ""};
    options.objects.push_back(static_cast<std::uint32_t>(found - c.objects.begin()));
  }
  return planned(
      "track", choice, who.value(),
      std::make_unique<TrackMission>(who.value().candidates, std::move(options)));
}

struct PatrolChoice : MissionSchedule {
  std::vector<Vec2> line = {{0, 0}, {1000, 0}};
  bool closed = false;
  double offset = 0;
  int rounds = 0;
};

Fields<PatrolChoice> patrol_fields() {
  using T = PatrolChoice;
  return with_schedule(
      Fields<T>()
          .point("line_m", &T::line, "Points of the line.")
          .items({.at_least = 2, .at_most = 10000})
          .boolean("closed", &T::closed, "Around, instead of there and back.")
          .number("offset_m", &T::offset, "Of the flight, to the right of the line.",
                  {.at_least = -1e5, .at_most = 1e5})
          .integer("rounds", &T::rounds, "Of each aircraft; 0: until the mission ends.",
                   {.at_least = 0, .at_most = 1000000}));
}

MadeTeam make_patrol(const PatrolChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  const Patrol patrol{choice.line, choice.closed, choice.offset, choice.rounds};
  return planned("patrol", choice, who.value(),
                 std::make_unique<PatrolMission>(who.value().candidates, patrol));
}

struct TourMissionChoice : MissionSchedule {
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {200, 350}};
  int laps = 3;
};

Fields<TourMissionChoice> tour_mission_fields() {
  using T = TourMissionChoice;
  return with_schedule(
      Fields<T>()
          .point("points_m", &T::points, "Flown through one after the other.")
          .items({.at_least = 2, .at_most = 10000})
          .integer("laps", &T::laps, "Times around, of each aircraft.",
                   {.at_least = 1, .at_most = 1000000}));
}

// Each aircraft flies the whole tour.
MadeTeam make_tour(const TourMissionChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  std::vector<ListedTask> tasks;
  for (const EntityId id : who.value().candidates)
    tasks.push_back({FlyTour{choice.points, choice.laps}, id});
  return planned("tour", choice, who.value(),
                 std::make_unique<TaskMission>(who.value().candidates, std::move(tasks)));
}

struct TaskChoice {
  std::string text, aircraft;
  std::optional<std::string> plan;  // file
};

struct TasksChoice : MissionSchedule {
  std::vector<TaskChoice> tasks;
};

Fields<TaskChoice> task_fields() {
  using T = TaskChoice;
  return Fields<T>()
      .task("task", &T::text,
            "The task, as in the command `task AIRCRAFT ...`: see docs/commands.md.")
      .file(
          "plan", &T::plan,
          "A plan that is flown as it is, instead: GeoJSON or CSV as `skein plan` writes "
          "them. Null: a task.")
      .text("aircraft", &T::aircraft,
            "Name of the aircraft that flies it. Empty: the nearest that is free.")
      .rule("task", [](const T& t) {
        return t.text.empty() == t.plan.has_value()
                   ? std::string()
                   : std::string("give either a task or a plan.");
      });
}

Fields<TasksChoice> tasks_fields() {
  using T = TasksChoice;
  return with_schedule(
      Fields<T>()
          .object("tasks", &T::tasks, task_fields(), "To be flown, in this order.")
          .items({.at_most = 10000}));
}

// The numbers of those that a task is about, in place of their names.
Result<ListedTask> listed(const TaskChoice& choice, const StationTeam& station,
                          const MissionContext& c) {
  const auto refuse = [&](std::string why) {
    return Error{ErrorCode::kBadInput, "tasks",
                 fmt::format("\"{}\": {}", choice.text, why), ""};
  };
  const auto find = [&](const std::string& name) -> std::optional<EntityId> {
    if (name == "station") return station.id;
    for (const TeamAircraft& each : station.team)
      if (each.name == name) return each.id;
    return std::nullopt;
  };
  ListedTask task;
  std::vector<EntityId> others;
  if (choice.plan) {
    auto plan = c.read_plan(*choice.plan);
    if (!plan) return plan.error();
    task.what = FlyPlan{std::move(plan).value()};
  } else {
    auto text = parse_task(choice.text, *c.kinds.task.forms());
    if (!text) return refuse(text.error().message);
    if (!text.value().file.empty()) return refuse("give a plan by the key plan.");
    task.what = std::move(text.value().what);
    for (const std::string& name : text.value().others) {
      const auto id = find(name);
      if (!id) return refuse(fmt::format("there is no aircraft \"{}\".", name));
      others.push_back(*id);
    }
  }
  bind_others(task.what, others);
  if (!choice.aircraft.empty()) {
    task.aircraft = find(choice.aircraft);
    if (!task.aircraft)
      return refuse(fmt::format("there is no aircraft \"{}\".", choice.aircraft));
  }
  if (std::string error = c.kinds.task.forms()->error(task.what); !error.empty())
    return refuse(std::move(error));
  return task;
}

MadeTeam make_tasks(const TasksChoice& choice, const MissionContext& c) {
  auto who = team_of(choice, c);
  if (!who) return who.error();
  std::vector<ListedTask> tasks;
  for (const TaskChoice& each : choice.tasks) {
    auto task = listed(each, *who.value().station, c);
    if (!task) return task.error();
    tasks.push_back(std::move(task).value());
  }
  return planned("tasks", choice, who.value(),
                 std::make_unique<TaskMission>(who.value().candidates, std::move(tasks)));
}

struct DelegatedChoice : TaskChoice {
  std::string name;
  std::vector<std::string> after;
  Time at;
  bool needs_camera = false, needs_fire_sensor = false, group = false;
};

struct DelegatedTasksChoice : MissionSchedule {
  std::vector<DelegatedChoice> tasks;
};

Fields<DelegatedTasksChoice> delegated_fields() {
  using T = DelegatedChoice;
  auto one =
      Fields<T>()
          .task(
              "task", [](T & t) -> auto& { return t.text; },
              "The task, as in the command `task AIRCRAFT ...`: see docs/commands.md.")
          .file(
              "plan", [](T & t) -> auto& { return t.plan; },
              "A plan that is flown as it is, instead. Null: a task.")
          .text("name", &T::name, "By which others come after it. Empty: none do.")
          .text("after", &T::after,
                "Names of tasks of the list that are done, or withdrawn, before it is "
                "flown.")
          .items({.at_most = 100})
          .duration_s("at_s", &T::at,
                      "When the operator adds it, from the begin of the mission.")
          .boolean("needs_camera", &T::needs_camera, "Only aircraft with a camera may.")
          .boolean("needs_fire_sensor", &T::needs_fire_sensor,
                   "Only aircraft with a fire sensor may.")
          .boolean("group", &T::group, "Several may fly it at once.")
          .rule("task", [](const T& t) {
            return t.text.empty() == t.plan.has_value()
                       ? std::string()
                       : std::string("give either a task or a plan.");
          });
  return with_schedule(Fields<DelegatedTasksChoice>()
                           .object("tasks", &DelegatedTasksChoice::tasks, one,
                                   "What the team is to do, in any order.")
                           .items({.at_most = 1000}));
}

// The places of named tasks in a list.
Result<std::map<std::string, std::size_t>> named_tasks(
    const std::vector<DelegatedChoice>& choices) {
  std::map<std::string, std::size_t> named;
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (!choices[k].name.empty() && !named.emplace(choices[k].name, k).second)
      return Error{ErrorCode::kBadInput, fmt::format("tasks[{}].name", k),
                   fmt::format("there are two tasks \"{}\".", choices[k].name), ""};
  return named;
}

// In the order in which they are added: by their times, and each behind those that it
// comes after.
Result<std::vector<DelegatedTask>> in_order(const std::vector<DelegatedChoice>& choices,
                                            std::vector<DelegatedTask> tasks) {
  const auto refuse = [](std::size_t k, std::string why) {
    return Error{ErrorCode::kBadInput, fmt::format("tasks[{}].after", k), std::move(why),
                 ""};
  };
  const auto named = named_tasks(choices);
  if (!named) return named.error();
  std::vector<std::vector<std::size_t>> before(tasks.size());
  for (std::size_t k = 0; k < tasks.size(); ++k)
    for (const std::string& name : choices[k].after) {
      const auto found = named.value().find(name);
      if (found == named.value().end())
        return refuse(k, fmt::format("there is no task \"{}\".", name));
      before[k].push_back(found->second);
    }
  std::vector<std::size_t> left(tasks.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  std::ranges::stable_sort(left, {}, [&](std::size_t k) { return tasks[k].at; });
  std::map<std::size_t, std::size_t> placed;
  std::vector<DelegatedTask> sorted;
  while (!left.empty()) {
    const auto next = std::ranges::find_if(left, [&](std::size_t k) {
      return std::ranges::all_of(before[k],
                                 [&](std::size_t b) { return placed.contains(b); });
    });
    if (next == left.end())
      return refuse(left.front(), "it comes after itself, by way of others.");
    DelegatedTask& task = sorted.emplace_back(std::move(tasks[*next]));
    for (const std::size_t b : before[*next]) task.after.push_back(placed.at(b));
    placed.emplace(*next, sorted.size() - 1);
    left.erase(next);
  }
  return sorted;
}

// Keys that say who flies a mission, which is the team's own matter.
std::string not_for_teams(const DelegatedTasksChoice& choice) {
  if (!choice.aircraft.empty()) return "aircraft";
  if (choice.min) return "min_aircraft";
  if (choice.max) return "max_aircraft";
  return choice.then == Afterwards::kHold ? "" : "then";
}

MadeTeam make_delegated(const DelegatedTasksChoice& choice, const MissionContext& c) {
  if (std::string key = not_for_teams(choice); !key.empty())
    return Error{ErrorCode::kBadInput, key,
                 "has no meaning here: the team finds by itself who flies what.",
                 "Leave it out."};
  auto who = team_of(choice, c);
  if (!who) return who.error();
  const StationTeam& station = *who.value().station;
  if (!station.desk)
    return Error{ErrorCode::kBadInput, "kind",
                 fmt::format("the team of {} does not lead itself.", station.name),
                 "Give the station a structure: stations[].team.structure."};
  std::vector<DelegatedTask> tasks;
  for (const DelegatedChoice& each : choice.tasks) {
    auto task = listed(each, station, c);
    if (!task) return task.error();
    DelegatedTask& made = tasks.emplace_back();
    made.at = each.at;
    made.task.what = std::move(task.value().what);
    made.task.group = each.group;
    if (each.needs_camera || choice.needs_camera) made.task.sensors |= kCameraSensor;
    if (each.needs_fire_sensor || choice.needs_fire_sensor)
      made.task.sensors |= kFireSensor;
  }
  auto ordered = in_order(choice.tasks, std::move(tasks));
  if (!ordered) return ordered.error();
  const std::string name = choice.name.empty() ? "team" : choice.name;
  return planned("team", choice, who.value(),
                 std::make_unique<DelegatedMission>(name, std::move(ordered).value(),
                                                    station.desk()));
}

}  // namespace

void add_team_missions(Kinds<PlannedMission, MissionContext>& kinds) {
  kinds.add(
      "survey", "Sees all of an area.", survey_fields(),
      [](const SurveyChoice& o, const MissionContext& c) { return make_survey(o, c); });
  kinds.add(
      "track", "Keeps objects on the ground in view.", track_fields(),
      [](const TrackChoice& o, const MissionContext& c) { return make_track(o, c); });
  kinds.add(
      "patrol", "Flies along a line again and again, evenly spaced.", patrol_fields(),
      [](const PatrolChoice& o, const MissionContext& c) { return make_patrol(o, c); });
  kinds.add("tour", "Each aircraft flies through points, on curves planned for the wind.",
            tour_mission_fields(),
            [](const TourMissionChoice& o, const MissionContext& c) {
              return make_tour(o, c);
            });
  kinds.add(
      "tasks", "An explicit list of tasks.", tasks_fields(),
      [](const TasksChoice& o, const MissionContext& c) { return make_tasks(o, c); });
  kinds.add(
      "team", "Tasks for a team that leads itself: who flies them it finds by itself.",
      delegated_fields(), [](const DelegatedTasksChoice& o, const MissionContext& c) {
        return make_delegated(o, c);
      });
}

}  // namespace skein::assemble
