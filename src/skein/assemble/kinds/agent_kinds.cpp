// SPDX-License-Identifier: Apache-2.0
// What reasons on board: one row each.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/assemble/kinds/task_kinds.h"
#include "skein/base/input_file.h"
#include "skein/exchange/traffic/well_clear_json.h"
#include "skein/layer/reasoning/agent/commanded/commanded_agent.h"
#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/trajectory/altitude.h"
#include "skein/layer/reasoning/trajectory/round_trip.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

Fields<SafetyZone> safety_zone_fields() {
  using T = SafetyZone;
  return Fields<T>()
      .duration_s("ahead_s", &T::ahead, "Ahead of the plan.", {.above = 0})
      .duration_s("behind_s", &T::behind, "Behind the plan.", {.above = 0})
      .number("across_m", &T::across, "Off the path, to either side.",
              {.above = 0, .at_most = 1e6});
}

enum class WellClearName { kSkeinSuas, kDo365B };

// How long a pilot takes, and whether.
struct PilotChoice {
  std::vector<double> reaction = {2, 20};  // from, to [s]
  double obeys = 1;
};

Fields<PilotChoice> pilot_fields() {
  using T = PilotChoice;
  return Fields<T>()
      .number("reaction_s", &T::reaction,
              "Until what is recommended is flown: from, to, drawn evenly each time.",
              {.at_least = 0, .at_most = 120})
      .items({.at_least = 2, .at_most = 2})
      .rule("reaction_s",
            [](const T& t) {
              return t.reaction[1] < t.reaction[0]
                         ? std::string("must not be longer first than last.")
                         : std::string();
            })
      .number("obeys", &T::obeys,
              "Chance that a recommendation is flown; else the pilot flies on.",
              {.at_least = 0, .at_most = 1});
}

struct AvoidanceChoice : reasoning::SeparationOptions {
  WellClearName well_clear_name = WellClearName::kSkeinSuas;
  std::string well_clear_file;
  std::optional<PilotChoice> pilot;
  std::optional<double> level_step;  // [m]
};

Fields<AvoidanceChoice> avoidance_fields() {
  using T = AvoidanceChoice;
  return Fields<T>()
      .word(
          "method", &T::method, "How it keeps apart from others of its team.",
          {{"none", SeparationMethod::kNone, "not at all, and it says nothing"},
           {"rule", SeparationMethod::kRule, "each alone, by the rules of the air"},
           {"priority", SeparationMethod::kPriority,
            "the lower one plans around the higher one"},
           {"negotiated", SeparationMethod::kNegotiated, "two agree on what both fly"},
           {"group", SeparationMethod::kGroup,
            "all whose conflicts hang together agree, up to twelve"},
           {"auto", SeparationMethod::kAuto,
            "negotiated, in groups, by priority, by rule or by height, as time is left"}})
      .word("deal", &T::deal,
            "Which deal two agree on; where both differ, the one further down.",
            {{"sum", reasoning::DealRule::kSum,
              "the least sum of costs: among aircraft of one owner"},
             {"product", reasoning::DealRule::kProduct,
              "the largest product of utilities, 1 - cost / 120 s"},
             {"zeuthen", reasoning::DealRule::kZeuthen,
              "by concessions over these utilities: of different owners"}})
      .word("intruder_room", &T::intruder_room,
            "What is kept free of the own flight where it meets an intruder.",
            {{"moving", reasoning::IntruderRoom::kMoving,
              "a cylinder around the intruder, wherever it is"},
             {"static", reasoning::IntruderRoom::kStatic,
              "an ellipse along its course around where the two would meet"}})
      .formerly("stranger_room")
      .number("horizontal_m", [](T & t) -> auto& { return t.separation.horizontal; },
              "Kept from others, unless the vertical distance is kept. Of a pair the "
              "larger counts, and how far both are off their plans on top.",
              {.above = 0, .at_most = 20000})
      .number("vertical_m", [](T & t) -> auto& { return t.separation.vertical; },
              "Kept from others, unless the horizontal distance is kept.",
              {.above = 0, .at_most = 5000})
      .number("level_step_m", &T::level_step,
              "Aircraft of a group that keep apart fly on levels of their own, each so "
              "much above the one before, eight at most, then from the first again. 0: "
              "all at altitude_agl_m. Null: three times vertical_m.",
              {.at_least = 0, .at_most = 5000})
      .boolean(
          "widens", &T::widens,
          "What is kept grows by how far the aircraft has been off its plans of late "
          "and by the uncertainty of its position. Else it is horizontal_m and "
          "vertical_m, whatever happens: for experiments.")
      .duration_s("horizon_s", &T::horizon, "How far ahead conflicts are looked for.",
                  {.at_least = 20, .at_most = 600})
      .word("well_clear", &T::well_clear_name,
            "By which numbers alerts about tracked intruders are given and bands made, "
            "whatever the method (docs/well-clear.md).",
            {{"skein_suas", WellClearName::kSkeinSuas, "small aircraft of 12 to 35 m/s"},
             {"DO_365B_no_SUM", WellClearName::kDo365B,
              "manned and large unmanned aircraft"}})
      .file("well_clear_file", &T::well_clear_file,
            "The same from a JSON file, in place of well_clear. Empty: none.",
            {.may_be_empty = true})
      .object("pilot", &T::pilot, pilot_fields(),
              "A pilot on board who flies, and is shown what keeps apart from others. "
              "Null: it is flown without anybody.");
}

// One agent, whatever the row: rows differ in what it flies first and in what of its
// tasks can be set.
struct AgentChoice {
  reasoning::OnboardAgentOptions agent;
  AvoidanceChoice avoidance;
  TaskOptions tasks;
};

// Of every row.
template <class T>
Fields<T> common_fields(Fields<T> fields, const char* across) {
  return std::move(fields)
      .duration_s("report_period_s", [](T & t) -> auto& { return t.agent.report_period; },
                  "Between reports to the station.", {.above = 0})
      .number(
          "report_target_load",
          [](T & t) -> auto& { return t.agent.report_rate.target_load; },
          "Where the radio has a medium, reports and readings are sent as rarely as it "
          "takes to keep its load at this, of 1; 0: always as often.",
          {.at_least = 0, .at_most = 1})
      .number(
          "zone_margin_m", [](T & t) -> auto& { return t.agent.avoidance.margin; },
          "Kept from the border of no-fly zones.", kNotNegative)
      .object(
          "avoidance", [](T & t) -> auto& { return t.avoidance; }, avoidance_fields(),
          "Keeping apart from others.")
      .object(
          "safety_zone", [](T & t) -> auto& { return t.agent.safety_zone; },
          safety_zone_fields(), across);
}

constexpr const char* kPathZone = "How far the flight of a path or plan may be off.";

Fields<AgentChoice> scout_fields() {
  using T = AgentChoice;
  return common_fields(
      Fields<T>().angle_deg(
          "edge_angle_deg", [](T & t) -> auto& { return t.tasks.edge_angle; },
          "Following the edge: between course and edge, to cross it again, "
          "whatever the strategy orders. Null: as it orders.",
          {.above = 0, .at_most = 90}),
      kPathZone);
}

Fields<AgentChoice> wingman_fields() {
  using T = AgentChoice;
  return common_fields(
      Fields<T>().duration_s("horizon_s",
                             [](T & t) -> auto& { return t.tasks.follow_horizon; },
                             "Following: the path to the place is planned for this long.",
                             {.above = 0, .at_most = 120}),
      kPathZone);
}

struct RouteChoice : AgentChoice {
  RouteChoice() { agent.takes_orders = false; }
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {400, 400}, {0, 400}};  // [m]
  int laps = 3;
  bool around_zones = false;  // those known from the start may lie on the route
};

Fields<RouteChoice> route_fields() {
  using T = RouteChoice;
  return common_fields(
      Fields<T>()
          .point("points_m", &T::points,
                 "Flown to one after the other, by straight legs.")
          .items({.at_least = 1, .at_most = 10000})
          .integer("laps", &T::laps, "Laps flown; it then stays at the last point.",
                   {.at_least = 1, .at_most = 1000000})
          .boolean(
              "lands", [](T & t) -> auto& { return t.tasks.lands; },
              "After the last lap it lands where it took off; when it began in the air, "
              "at the first point.")
          .boolean("around_zones", &T::around_zones,
                   "It flies around no-fly zones that lie on the route from the start; "
                   "else such a route is refused. Zones that come later it always flies "
                   "around."),
      "How far the flight may be off the route.");
}

// Points that follow one another, the first after the last, at one place.
std::string repeated_point(const std::vector<Vec2>& points) {
  constexpr double kOnePlace = 1e-3;  // [m]
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    if ((points[next] - points[i]).norm() < kOnePlace)
      return fmt::format("points {} and {} are at one place.", i + 1, next + 1);
  }
  return {};
}

struct DirectChoice : AgentChoice {
  DirectChoice() { agent.takes_orders = false; }
  Vec2 point = {1000, 0};              // [m]
  std::optional<double> altitude_msl;  // [m]
  std::optional<double> airspeed;      // [m/s]; none: cruise
};

Fields<DirectChoice> direct_fields() {
  using T = DirectChoice;
  return common_fields(
      Fields<T>()
          .point("point_m", &T::point, "Where it flies to, and circles then.")
          .number("altitude_msl_m", &T::altitude_msl,
                  "Reached evenly until there. Null: altitude_agl_m above the ground.",
                  {.at_least = -500, .at_most = 30000})
          .number("airspeed_mps", &T::airspeed,
                  "That it plans with, within what the aircraft flies. Null: cruise.",
                  {.above = 0, .at_most = 500})
          .boolean(
              "stays", [](T & t) -> auto& { return t.tasks.stays; },
              "Others of its team count with the circle that it flies there. False: "
              "what comes after is not said, as it leaves the run at the point."),
      "How far the flight may be off its plan.");
}

struct TourChoice : AgentChoice {
  TourChoice() { agent.takes_orders = false; }
  std::vector<Vec2> points = {{0, 0}, {400, 0}, {200, 350}};  // [m]
  int laps = 3;
};

Fields<TourChoice> tour_fields() {
  using T = TourChoice;
  using reasoning::TourCurves;
  return common_fields(
      Fields<T>()
          .point("points_m", &T::points,
                 "Flown through one after the other, across the bisector of each corner.")
          .items({.at_least = 2, .at_most = 10000})
          .rule("points_m", [](const T& t) { return repeated_point(t.points); })
          .integer("laps", &T::laps, "Laps flown; it then circles the last point.",
                   {.at_least = 1, .at_most = 1000000})
          .word("curves", [](T & t) -> auto& { return t.tasks.tour.curves; },
                "What the path is planned with.",
                {{"trochoids", TourCurves::kTrochoids,
                  "turns and straights in the wind as it is believed to be"},
                 {"dubins", TourCurves::kDubins,
                  "turns and straights over ground, as if there were no wind"}})
          .number("radius_factor",
                  [](T & t) -> auto& { return t.tasks.tour.radius_factor; },
                  "Radius of planned turns over the minimum of the aircraft.",
                  {.at_least = 1, .at_most = 100})
          .duration_s("settling_s", [](T & t) -> auto& { return t.tasks.tour.settling; },
                      "Circling before it plans, to learn of the wind.", {.at_least = 0})
          .boolean(
              "keeps_times", [](T & t) -> auto& { return t.tasks.tour.keeps_times; },
              "The plan is flown in time; else at cruise airspeed.")
          .boolean(
              "replans", [](T & t) -> auto& { return t.tasks.tour.replans; },
              "When it leaves the safety zone it plans anew from where it is."),
      "How far the flight may be off the plan.");
}

Result<std::shared_ptr<const model::WellClearConfiguration>> well_clear_of(
    const AvoidanceChoice& choice) {
  using model::WellClearConfiguration;
  using Shared = std::shared_ptr<const WellClearConfiguration>;
  if (choice.well_clear_file.empty()) {
    if (choice.well_clear_name == WellClearName::kSkeinSuas) return Shared();
    return Shared(std::make_shared<const WellClearConfiguration>(
        *model::well_clear_configuration("DO_365B_no_SUM")));
  }
  const auto bad = [&](Error error) {
    error.place = "aircraft.agent.avoidance.well_clear_file: " + error.place;
    return error;
  };
  const auto text = read_file(choice.well_clear_file);
  if (!text) return bad(text.error());
  auto read =
      exchange::well_clear_configuration_from_json(text.value(), choice.well_clear_file);
  if (!read) return bad(read.error());
  return Shared(std::make_shared<const WellClearConfiguration>(std::move(read).value()));
}

Result<reasoning::SeparationOptions> separation_of(const AvoidanceChoice& choice) {
  constexpr double kMargin = 1;  // of a recommendation after the slowest reaction [s]
  reasoning::SeparationOptions options = choice;
  auto well_clear = well_clear_of(choice);
  if (!well_clear) return well_clear.error();
  options.well_clear = std::move(well_clear).value();
  options.holding_step = 3 * choice.separation.vertical;
  // What is recommended begins when the pilot will have decided.
  if (choice.pilot)
    options.reaction = std::max(options.reaction, choice.pilot->reaction[1] + kMargin);
  return options;
}

// How much higher than the first of its group an aircraft flies [m].
double level_of(const AvoidanceChoice& choice, const AircraftContext& c) {
  constexpr std::size_t kLevels = 8;
  if (choice.method == SeparationMethod::kNone) return 0;
  const double step = choice.level_step.value_or(3 * choice.separation.vertical);
  return step * static_cast<double>(c.index % kLevels);
}

Result<std::unique_ptr<Agent>> make_agent(const AgentChoice& choice,
                                          const AircraftContext& c,
                                          std::optional<TaskKind> first = {}) {
  reasoning::OnboardAgentOptions options = choice.agent;
  auto separation = separation_of(choice.avoidance);
  if (!separation) return separation.error();
  options.separation = std::move(separation).value();
  options.separation.place_period = c.place_period;
  if (const auto& pilot = choice.avoidance.pilot)
    options.pilot = reasoning::AdvisedPilotOptions{pilot->reaction[0], pilot->reaction[1],
                                                   pilot->obeys, c.seed};
  options.first_task = std::move(first);
  options.watchers = c.watchers;
  if (options.takes_orders && c.team) options.team = *c.team;
  const reasoning::FlightContext context{c.self, c.limits, c.map.get(), c.planner,
                                         c.altitude_agl + level_of(choice.avoidance, c)};
  TaskOptions tasks = choice.tasks;
  tasks.has_camera = c.has_camera;
  return std::unique_ptr<Agent>(std::make_unique<reasoning::OnboardAgent>(
      options, c.station, context, c.zones,
      [kinds = c.tasks, tasks](const TaskKind& task,
                               const reasoning::FlightContext& flown) {
        return kinds->make(task, {flown, tasks});
      }));
}

Result<std::unique_ptr<Agent>> make_direct(const DirectChoice& options,
                                           AircraftContext c) {
  if (options.airspeed) {
    if (*options.airspeed < c.limits.slowest || *options.airspeed > c.limits.fastest)
      return Error{
          ErrorCode::kBadInput, "aircraft.agent.airspeed_mps",
          fmt::format("{:.1f} m/s is not flown by this aircraft.", *options.airspeed),
          fmt::format("It flies {:.1f} to {:.1f} m/s.", c.limits.slowest,
                      c.limits.fastest)};
    const double ratio = *options.airspeed / c.limits.airspeed;
    c.limits.airspeed = *options.airspeed;
    c.limits.turn_radius *= ratio * ratio;  // with the same bank
  }
  return make_agent(options, c, FlyTo{options.point, options.altitude_msl});
}

// Zones that forbid these altitudes at any time.
std::vector<Zone> lasting(const std::vector<Zone>& zones, double low, double high) {
  std::vector<Zone> some;
  for (const Zone& zone : zones)
    if (zone.from <= 0 && std::isinf(zone.until) && concerns(zone, low, high, 0, 0))
      some.push_back(zone);
  return some;
}

Result<std::unique_ptr<Agent>> make_route(const RouteChoice& options,
                                          const AircraftContext& c) {
  const double start = -c.initial.p_N.z();
  const double altitude =
      reasoning::highest_along(*c.map, options.points) + c.altitude_agl;
  std::vector<Zone> zones;
  if (!options.around_zones)
    zones = lasting(c.zones, std::min(start, altitude), std::max(start, altitude));
  // From the start to the first point, then the lap.
  std::vector<Vec2> leg = {geo::horizontal(c.initial.p_N), options.points.front()};
  auto crossed = reasoning::into_zone(leg, false, zones);
  if (!crossed) crossed = reasoning::into_zone(options.points, options.laps > 1, zones);
  if (crossed)
    return Error{
        ErrorCode::kBadInput, "aircraft.agent.points_m",
        fmt::format("the route leads into a no-fly zone at {:.0f} m north, {:.0f} m "
                    "east.",
                    crossed->x(), crossed->y()),
        "Lead it around the zone (the leg from the start to the first point counts too), "
        "or set around_zones."};
  return make_agent(options, c, FlyRoute{options.points, options.laps, {}});
}

}  // namespace

namespace {

Fields<reasoning::CommandedAgentOptions> commanded_fields() {
  using T = reasoning::CommandedAgentOptions;
  return Fields<T>()
      .number("take_off_height_m", &T::take_off_height,
              "Above home, of a take-off without an altitude.",
              {.above = 0, .at_most = 1000})
      .duration_s("setpoint_patience_s", &T::patience,
                  "Without a new setpoint for so long it holds its place.",
                  {.at_least = 0.5, .at_most = 60});
}

}  // namespace

Kinds<Agent, AircraftContext> agent_kinds() {
  Kinds<Agent, AircraftContext> kinds("agent");
  kinds.add("scout", "Reads the fire sensor, reports to the station, flies its orders.",
            scout_fields(), [](const AgentChoice& o, const AircraftContext& c) {
              return make_agent(o, c);
            });
  kinds.add("wingman", "Leads a formation along a route, or keeps its place in it.",
            wingman_fields(), [](const AgentChoice& o, const AircraftContext& c) {
              return make_agent(o, c);
            });
  kinds.add(
      "route", "Flies a route of its own; takes no orders.", route_fields(),
      [](const RouteChoice& o, const AircraftContext& c) { return make_route(o, c); });
  kinds.add(
      "direct", "Flies to one place by the quickest path in the wind; takes no orders.",
      direct_fields(),
      [](const DirectChoice& o, const AircraftContext& c) { return make_direct(o, c); });
  kinds.add("tour",
            "Flies through points on turns and straights planned for the wind; takes no "
            "orders.",
            tour_fields(), [](const TourChoice& o, const AircraftContext& c) {
              return make_agent(o, c, FlyTour{o.points, o.laps});
            });
  kinds.add("commanded",
            "Flies what programs outside ask for by MAVLink, from moment to moment, to "
            "places or a stored mission; nothing of its own.",
            commanded_fields(),
            [](const reasoning::CommandedAgentOptions& o, const AircraftContext& c) {
              return std::make_unique<reasoning::CommandedAgent>(o, c.self, c.limits,
                                                                 c.map);
            });
  return kinds;
}

}  // namespace skein::assemble
