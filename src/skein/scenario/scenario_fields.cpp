// SPDX-License-Identifier: Apache-2.0
// Every key of a scenario but those of the kinds, one line each: reading, checking,
// writing, `skein schema` and the documentation all come from here. A new key is a member
// in scenario.h and a line below.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/data/command/command_text.h"
#include "skein/scenario/environment_fields.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/scenario.h"
#include "skein/scenario/zones.h"

namespace skein::scenario {
namespace {

constexpr Count kMaxGroups{.at_most = 1000};

Fields<geo::Geodetic> origin_fields() {
  using T = geo::Geodetic;
  return Fields<T>()
      .number("latitude_deg", &T::latitude_deg, "Latitude of the local frame's origin.",
              {.at_least = -89, .at_most = 89})
      .number("longitude_deg", &T::longitude_deg,
              "Longitude of the local frame's origin, east positive.",
              {.at_least = -180, .at_most = 180});
}

Fields<Start> start_fields() {
  using T = Start;
  return Fields<T>()
      .word(
          "placement", &T::placement, "How the aircraft stand.",
          {{"opposite", Placement::kOpposite,
            "evenly around the centre, facing it; two stand on opposite sides"},
           {"ring", Placement::kRing, "evenly around the centre, flying along the ring"},
           {"line", Placement::kLine, "side by side, across the heading"},
           {"list", Placement::kList, "at `positions_m`"}})
      .point("centre_m", &T::centre, "Centre of the group.")
      .number("distance_m", &T::distance, "Opposite, ring: distance from the centre.",
              {.at_least = 0, .at_most = 1e6})
      .angle_deg("first_bearing_deg", &T::first_bearing,
                 "Opposite, ring: bearing of the first aircraft, seen from the centre.",
                 kBearing)
      .number("spacing_m", &T::spacing, "Line: distance between neighbours.", kLength)
      .point("positions_m", &T::positions, "List: one place for each aircraft.")
      .number(
          "altitude_msl_m", &T::altitude_msl,
          "Altitude at the start, above mean sea level. Null: altitude_agl_m above the "
          "ground there.",
          {.at_least = -500, .at_most = 30000})
      .boolean("on_ground", &T::on_ground,
               "Stands on the ground at the start, for take-off; needs a plant that can.")
      .boolean(
          "held", &T::held,
          "Fixed wings on the ground: a crew holds it still until its motor is given "
          "power, and throws it into the wind if its aircraft file has hand_launch. "
          "Else it stands by itself, and gusts may move it.")
      .angle_deg(
          "heading_deg", &T::heading,
          "Heading at the start, clockwise from north. Null: to the centre (line: "
          "north; ring: along it, clockwise); a fixed wing on the ground is faced "
          "into the wind that blows there at the start. A heading that is given is "
          "that of the runway: it takes off along it.",
          kBearing);
}

constexpr const char* kPartHelp =
    "Which part. Motor: its channel, from 0 (empty: the only one of a fixed wing, the "
    "first of a multirotor). Servo: aileron, elevator or rudder. Sensor: its kind, "
    "or imu#2 for the second of several (empty: all).";

Fields<Failure> failure_fields() {
  using T = Failure;
  using Kind = Failure::Kind;
  return Fields<T>()
      .duration_s("at_s", &T::at, "When it happens.")
      .required()
      .word("kind", &T::kind, "What happens.",
            {{"lost", Kind::kLost, "it falls silent where it is"},
             {"land", Kind::kLand,
              "it leaves the run, wherever it is: no landing is flown"},
             {"motor", Kind::kMotor, "a motor gives nothing"},
             {"servo-stuck", Kind::kServoStuck, "a servo stays where it is"},
             {"servo-loose", Kind::kServoLoose, "a surface swings freely"},
             {"sensor", Kind::kSensor, "a sensor says nothing"},
             {"battery", Kind::kBattery, "the battery gives nothing"},
             {"link", Kind::kLink, "no message goes in or out"}})
      .text("part", &T::part, kPartHelp)
      .integer("aircraft", &T::aircraft, "Which aircraft of the group, from 0.",
               {.at_least = 0, .at_most = 9999})
      .duration_s("until_s", &T::until, "When it takes part again. Null: never.")
      .rule("until_s", [](const T& t) {
        const bool back_too_early = t.until && *t.until <= t.at;
        return back_too_early ? std::string("must be after at_s.") : std::string();
      });
}

Fields<RandomFailure> random_failure_fields() {
  using T = RandomFailure;
  using Kind = Failure::Kind;
  return Fields<T>()
      .word("kind", &T::kind, "What happens.",
            {{"motor", Kind::kMotor, "a motor gives nothing"},
             {"servo-stuck", Kind::kServoStuck, "a servo stays where it is"},
             {"servo-loose", Kind::kServoLoose, "a surface swings freely"},
             {"sensor", Kind::kSensor, "a sensor says nothing"},
             {"battery", Kind::kBattery, "the battery gives nothing"},
             {"link", Kind::kLink, "no message goes in or out"}})
      .required()
      .text("part", &T::part, kPartHelp)
      .duration_s("mean_between_s", &T::mean_between,
                  "Mean time to the next one, for each aircraft; exponential.",
                  {.above = 0})
      .duration_s("length_s", &T::length, "How long it lasts. Null: for good.",
                  {.above = 0});
}

std::string positions_error(const AircraftGroup& group) {
  const std::size_t points = group.start.positions.size();
  if (group.start.placement != Placement::kList || std::cmp_equal(points, group.count)) {
    return {};
  }
  return fmt::format("{} positions_m for {} aircraft; needs one each.", points,
                     group.count);
}

std::string observes_error(const AircraftGroup& group) {
  const bool physical = group.physical.value_or(group.vehicle.kind != "simulated");
  return group.observes == Reality::kPhysical && !physical
             ? std::string(
                   "physical needs physical: true: what is simulated sees the "
                   "physical world beside its own. Say both.")
             : std::string();
}

std::string failures_error(const AircraftGroup& group) {
  for (const Failure& failure : group.failures) {
    if (failure.aircraft >= group.count) {
      return fmt::format("aircraft {} of a group of {}; they are counted from 0.",
                         failure.aircraft, group.count);
    }
  }
  return {};
}

Fields<AircraftGroup> aircraft_fields() {
  using T = AircraftGroup;
  return Fields<T>()
      .text("name", &T::name, "Name of the group; its aircraft are name-1, name-2, ...")
      .integer("count", &T::count, "How many aircraft.",
               {.at_least = 0, .at_most = 10000})
      .kind("vehicle", &T::vehicle, "vehicle",
            "Whether it is simulated here, or elsewhere, or is real.")
      .kind("plant", &T::plant, "plant", "How the aircraft moves.")
      .number("parameter_spread", &T::parameter_spread,
              "Mass, inertia and each coefficient of an aircraft differ from its plant's "
              "by at "
              "most this share, at random; its autopilot does not know.",
              {.at_least = 0, .at_most = 0.3})
      .kind("autopilot", &T::autopilot, "autopilot", "How it is flown.")
      .kind("sensors", &T::sensors, "sensor", "What it senses with.")
      .items({.at_most = 50})
      .kind("agent", &T::agent, "agent", "What reasons on board.")
      .word("transmits", &T::transmits,
            "What it carries by which other aircraft may notice it. Radars find it "
            "without.",
            transmitter_words())
      .items({.at_most = 3})
      .boolean("physical", &T::physical,
               "Its body exists in reality. A simulated one stands for a real one then, "
               "and so do its sensors. Null: unless it is simulated.")
      .word(
          "observes", &T::observes,
          "Which objects its sensors see. Without a body in reality it sees physical "
          "ones where the server remembers them. Null: virtual; physical for a simulated "
          "aircraft that is physical.",
          {{"virtual", Reality::kVirtual, "those that exist in the simulation"},
           {"physical", Reality::kPhysical, "those that exist in reality"},
           {"both", Reality::kBoth, "all of them"}})
      .rule("observes", observes_error)
      .text("station", &T::station,
            "Ground station that it belongs to. Empty: the first.")
      .number("altitude_agl_m", &T::altitude_agl, "Flight altitude above ground.",
              {.above = 0, .at_most = 20000})
      .duration_s("agent_period_s", &T::agent_period,
                  "Time between two steps of the agent.", kPeriod)
      .duration_s("flight_step_s", &T::flight_step,
                  "Time step of plant, autopilot and its sensors; step_s is a multiple. "
                  "Null: 0.01 s for plants that take actuators, else step_s.",
                  {.at_least = 0.0005, .at_most = 10})
      .object("start", &T::start, start_fields(), "Place at the start.")
      .duration_s("join_s", &T::join, "When the group joins.")
      .duration_s("leave_s", &T::leave,
                  "When the group leaves the run, wherever it is: no landing is "
                  "flown. Null: never.")
      .duration_s("return_s", &T::comeback,
                  "When the group takes part again after leave_s. Null: never.")
      .object("failures", &T::failures, failure_fields(),
              "What happens to single aircraft.")
      .items({.at_most = 10000})
      .object("random_failures", &T::random_failures, random_failure_fields(),
              "What happens to each of them by chance.")
      .items({.at_most = 100})
      .rule("leave_s",
            [](const T& t) {
              const bool early = t.leave && *t.leave <= t.join;
              return early ? std::string("must be after join_s.") : std::string();
            })
      .rule("return_s",
            [](const T& t) {
              if (!t.comeback) return std::string();
              if (!t.leave) return std::string("needs leave_s, which is not given.");
              return *t.comeback <= *t.leave ? std::string("must be after leave_s.")
                                             : std::string();
            })
      .rule("start", positions_error)
      .rule("failures", failures_error);
}

Fields<TeamSetup> team_fields() {
  using T = TeamSetup;
  using Structure = TeamSetup::Structure;
  using Allocation = TeamSetup::Allocation;
  return Fields<T>()
      .word("structure", &T::structure,
            "Who shares out the tasks of missions of the kind `team`.",
            {{"none", Structure::kNone, "nobody: there are none"},
             {"master", Structure::kLeader,
              "one of the aircraft, which they elect; another one when it is lost"},
             {"fixed-master", Structure::kFixedLeader,
              "the station, as long as they receive it"},
             {"auction", Structure::kAuction,
              "nobody: each bids, and the highest bid wins"}})
      .word(
          "allocation", &T::allocation, "How a leader shares them.",
          {{"coalitions", Allocation::kCoalitions,
            "one task each, by sensors, endurance and time in wind and around zones, for "
            "the highest utility"},
           {"sequences", Allocation::kSequences,
            "several tasks each in the order in which they are flown, so that the last "
            "one ends soon; not in an auction"},
           {"nearest", Allocation::kNearest,
            "each keeps its task, others get the nearest"}})
      .duration_s("query_period_s", &T::query_period,
                  "Between two queries of a master. Who is silent for four of them, more "
                  "where messages are lost, counts as lost. Null: 1 s, more where the "
                  "radio is narrow (docs/team.md).",
                  {.at_least = 0.5, .at_most = 60})
      .number("mission_diameter_m", &T::diameter,
              "Beyond the range of the radio it takes longer until somebody counts as "
              "lost. Null: that of the tasks.",
              {.above = 0, .at_most = 1e6})
      .boolean("approval", &T::approval,
               "Allocations that a master works out wait until the operator approves "
               "them: `allocation approve`.")
      .rule("allocation",
            [](const T& t) {
              return t.structure == Structure::kAuction &&
                             t.allocation == Allocation::kSequences
                         ? std::string("bids are for one task: sequences need a leader.")
                         : std::string();
            })
      .rule("approval", [](const T& t) {
        const bool leads =
            t.structure == Structure::kLeader || t.structure == Structure::kFixedLeader;
        return !t.approval || leads ? std::string()
                                    : std::string(
                                          "needs a structure in which somebody "
                                          "leads: master or fixed-master.");
      });
}

Fields<Station> station_fields() {
  using T = Station;
  return Fields<T>()
      .text("name", &T::name, "What it is called; each name once.")
      .point("position_m", &T::position, "Where it stands.")
      .number("antenna_agl_m", &T::antenna_agl, "Height of its antenna above ground.",
              {.at_least = 0, .at_most = 1000})
      .duration_s("agent_period_s", &T::agent_period, "Time between two decisions.",
                  kPeriod)
      .duration_s("heartbeat_s", &T::heartbeat,
                  "Time between two heartbeats to each of its aircraft; 0: none. Null: 1 "
                  "s where an autopilot watches the link, else none.",
                  {.at_least = 0, .at_most = 3600})
      .object("team", &T::team, team_fields(),
              "Its aircraft as a team that leads itself; see docs/team.md.");
}

Fields<Recording> record_fields() {
  using T = Recording;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz,
              "Rows of truth and estimates per second and aircraft.",
              {.above = 0, .at_most = 1000})
      .duration_s("metrics_period_s", &T::metrics_period, "Time between two metrics.",
                  kPeriod)
      .duration_s("perimeter_period_s", &T::perimeter_period,
                  "Time between two stored perimeters.", kPeriod)
      .duration_s("radio_period_s", &T::radio_period,
                  "Time between two rows of what radios did and how links were.", kPeriod)
      .boolean("messages", &T::messages, "Whether messages are stored.");
}

Fields<StationLink> station_link_fields() {
  using T = StationLink;
  return Fields<T>()
      .text("endpoint", &T::endpoint,
            "Where, such as udpout:127.0.0.1:14550 or tcpin:5760; see docs/links.md.")
      .required()
      .boolean("signed", &T::is_signed,
               "Frames are signed with the key of key_file, others refused.")
      .word("unsigned", &T::unsigned_frames,
            "What frames without a signature may do: docs/links.md.",
            {{"auto", T::Unsigned::kAuto,
              "nothing where frames are signed; else all from this machine, and "
              "telemetry from beyond it"},
             {"all", T::Unsigned::kAll,
              "command, set parameters and upload missions, from anywhere"},
             {"telemetry", T::Unsigned::kTelemetry,
              "report and ask; commands, parameters and missions are refused"}})
      .rule("unsigned", [](const T& t) {
        return t.is_signed && t.unsigned_frames == T::Unsigned::kAll
                   ? std::string("is all, so that signed would not protect anything.")
                   : std::string();
      });
}

Fields<Links> links_fields() {
  return Fields<Links>()
      .object("ground_stations", &Links::ground_stations, station_link_fields(),
              "Programs of ground stations, such as QGroundControl.")
      .items({.at_most = 20})
      .word("autopilot", &Links::autopilot,
            "What simulated aircraft look like to ground stations.",
            {{"ardupilot", ShownAs::kArduPilot, "ArduPilot"},
             {"px4", ShownAs::kPx4, "PX4"}})
      .integer(
          "first_system", &Links::first_system,
          "System id of the first simulated aircraft; the others follow, 250 on each "
          "port.",
          {.at_least = 1, .at_most = 250})
      .file("key_file", &Links::key_file,
            "With the key of signed links, which nobody else may be able to read; \"\": "
            "none.",
            {.may_be_empty = true});
}

// Periods that are no whole number of steps.
std::vector<RuleViolation> period_errors(const Scenario& scenario,
                                         const ValidValues& valid) {
  std::vector<RuleViolation> errors;
  if (!valid("step_s")) return errors;
  const Time step = scenario.step;
  const auto steps_near = [&](double seconds) {
    return std::max<std::int64_t>(1, std::llround(seconds / step.seconds()));
  };
  const auto check = [&](const std::string& key, Time period) {
    if (!valid(key) || period.ns() % step.ns() == 0) return;
    errors.push_back(
        {key,
         fmt::format("{} s is no whole number of steps of {} s (step_s); the "
                     "nearest is {}.",
                     seconds_text(period), seconds_text(step),
                     seconds_text(step * steps_near(period.seconds()))),
         {"step_s"}});
  };
  if (scenario.environment.period)
    check("environment.period_s", *scenario.environment.period);
  for (std::size_t i = 0; i < scenario.aircraft.size(); ++i) {
    check(fmt::format("aircraft[{}].agent_period_s", i),
          scenario.aircraft[i].agent_period);
    const auto& flight_step = scenario.aircraft[i].flight_step;
    const std::string key = fmt::format("aircraft[{}].flight_step_s", i);
    if (valid(key) && flight_step && step.ns() % flight_step->ns() != 0)
      errors.push_back({key,
                        fmt::format("{} s does not divide step_s, {} s.",
                                    seconds_text(*flight_step), seconds_text(step)),
                        {"step_s"}});
  }
  for (std::size_t i = 0; i < scenario.stations.size(); ++i)
    check(fmt::format("stations[{}].agent_period_s", i),
          scenario.stations[i].agent_period);
  check("record.metrics_period_s", scenario.record.metrics_period);
  if (!valid("record.rate_hz")) return errors;
  // A rate is a rounded number: 3.33333 means every third step of 0.1 s.
  const double rows = 1 / scenario.record.rate_hz;
  const double nearest = static_cast<double>(steps_near(rows)) * step.seconds();
  if (std::abs(rows - nearest) > 1e-5 * nearest)
    errors.push_back(
        {"record.rate_hz",
         fmt::format(
             "{:.6g} rows a second are not one every whole number of steps of {} s "
             "(step_s); the nearest is {:.6g}.",
             scenario.record.rate_hz, seconds_text(step), 1 / nearest),
         {"step_s"}});
  return errors;
}

// Stations of one name, and names of none.
std::vector<RuleViolation> station_errors(const Scenario& scenario,
                                          const ValidValues& valid) {
  std::vector<RuleViolation> errors;
  if (!valid("stations")) return errors;
  std::set<std::string> names;
  for (std::size_t i = 0; i < scenario.stations.size(); ++i)
    if (!names.insert(scenario.stations[i].name).second)
      errors.push_back({fmt::format("stations[{}].name", i),
                        fmt::format("another station is called \"{}\" too.",
                                    scenario.stations[i].name),
                        {"stations"}});
  for (std::size_t i = 0; i < scenario.aircraft.size(); ++i) {
    const std::string& name = scenario.aircraft[i].station;
    if (!name.empty() && names.count(name) == 0)
      errors.push_back({fmt::format("aircraft[{}].station", i),
                        fmt::format("there is no station \"{}\".", name),
                        {"stations"}});
  }
  return errors;
}

}  // namespace

namespace {

Fields<PlannedCommand> command_fields() {
  using T = PlannedCommand;
  return Fields<T>()
      .duration_s("at_s", &T::at, "When it is given.", {.at_least = 0})
      .required()
      .order(
          "do", &T::text,
          "The command, as in a terminal: see docs/commands.md. A file that it names is "
          "relative to the scenario.")
      .required();
}

}  // namespace

Fields<Scenario> scenario_fields() {
  using T = Scenario;
  return Fields<T>()
      .text("name", &T::name, "Name of the run, for reports.")
      .file("plugins", &T::plugins,
            "Shared libraries that bring kinds of their own; see docs/extending.md.")
      .integer("seed", &T::seed, "Seed of all randomness: same seed, same run.",
               {.at_least = 0})
      .duration_s("duration_s", &T::duration, "Length of the run.", {.above = 0})
      .duration_s("step_s", &T::step, "Time step of the simulation.",
                  {.at_least = 0.001, .at_most = 10})
      .object("origin", &T::origin, origin_fields(),
              "Where on Earth the local frame (north, east) starts.")
      .utc("start_utc", &T::start_utc, "When the run starts.")
      .object("environment", &T::environment, environment_fields(),
              "Ground, air and fire.")
      .object("aircraft", &T::aircraft, aircraft_fields(), "Groups of equal aircraft.")
      .items(kMaxGroups)
      .object("traffic", &T::traffic, traffic_fields(),
              "Other aircraft around, which belong to nobody; see docs/traffic.md.")
      .items(kMaxGroups)
      .kind("radio", &T::radio, "radio", "The channel between all of them.")
      .object("stations", &T::stations, station_fields(), "Ground stations.")
      .items({.at_least = 1, .at_most = 100})
      .kind("missions", &T::missions, "mission", "What is wanted of the aircraft.")
      .items({.at_most = 1000})
      .object("commands", &T::commands, command_fields(),
              "What the scenario commands by itself, as an operator would.")
      .items({.at_most = 10000})
      .object("links", &T::links, links_fields(), "Other programs that take part.")
      .object("record", &T::record, record_fields(), "What is stored.")
      .rules_of_valid(period_errors)
      .rules_of_valid(station_errors);
}

}  // namespace skein::scenario
