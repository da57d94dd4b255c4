#include "skein/data/command_text.h"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string>

#include "skein/data/json.h"
#include "skein/data/words.h"
#include "skein/data/zone_command.h"

namespace skein {
namespace {

using Words = std::span<const std::string_view>;

constexpr double kMaxSpeedFactor = 1e9;
constexpr double kMaxWind = 100;  // [m/s]
constexpr double kMaxCount = 1e6;

Error wrong(std::string message, const char* usage) {
  return {ErrorCode::kBadInput, "", std::move(message), usage};
}

constexpr const char* kUsage =
    "Commands: zone, task, mission, pause, resume, step, speed, fault, repair, wind, "
    "add, "
    "remove.";
constexpr const char* kTaskUsage =
    "Say: task AIRCRAFT, then loiter, fly_to NORTH,EAST; course DEGREES; line, route, "
    "tour "
    "NORTH,EAST NORTH,EAST ... [laps N]; follow_edge NORTH,EAST clockwise or "
    "counterclockwise.";

std::optional<double> finite_number(std::string_view word) {
  const auto value = words::number(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<Vec2> finite_place(std::string_view word) {
  const auto value = words::place(word);
  return value && value->allFinite() ? value : std::nullopt;
}

// A count from 1 on.
std::optional<int> count(std::string_view word) {
  const auto value = finite_number(word);
  if (!value || *value < 1 || *value > kMaxCount || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<int>(*value);
}

// All words as places; empty when one is none.
std::vector<Vec2> places(Words given) {
  std::vector<Vec2> all;
  for (const std::string_view word : given) {
    const auto point = finite_place(word);
    if (!point) return {};
    all.push_back(*point);
  }
  return all;
}

std::optional<TaskKind> route(Words given) {
  FlyRoute route;
  if (given.size() > 2 && given[given.size() - 2] == "laps") {
    const auto laps = count(given.back());
    if (!laps) return std::nullopt;
    route.laps = *laps;
    given = given.first(given.size() - 2);
  }
  route.points = places(given);
  if (route.points.empty()) return std::nullopt;
  return route;
}

std::optional<TaskKind> tour(Words given) {
  const auto order = route(given);
  if (!order) return std::nullopt;
  const FlyRoute& through = std::get<FlyRoute>(*order);
  if (through.points.size() < 2) return std::nullopt;
  return FlyTour{through.points, through.laps};
}

std::optional<TaskKind> follow_edge(Words given) {
  if (given.size() != 2) return std::nullopt;
  const auto start = finite_place(given[0]);
  const bool clockwise = given[1] == "clockwise";
  if (!start || (!clockwise && given[1] != "counterclockwise")) return std::nullopt;
  FollowEdge edge;
  edge.clockwise = clockwise;
  edge.start = *start;
  return edge;
}

std::optional<TaskKind> task_kind(std::string_view kind, Words given) {
  const auto point = given.size() == 1 ? finite_place(given[0]) : std::nullopt;
  if (kind == "loiter" && point) return Loiter{*point};
  if (kind == "fly_to" && point) return FlyTo{*point};
  const auto course = given.size() == 1 ? finite_number(given[0]) : std::nullopt;
  if (kind == "course" && course) return FlyCourse{geo::radians(*course)};
  if (kind == "line")
    if (auto points = places(given); points.size() >= 2)
      return FollowLine{std::move(points)};
  if (kind == "route") return route(given);
  if (kind == "tour") return tour(given);
  if (kind == "follow_edge") return follow_edge(given);
  return std::nullopt;
}

Result<Command> task(Words given) {
  if (given.size() < 3) return wrong("a task needs an aircraft and a kind.", kTaskUsage);
  auto what = task_kind(given[1], given.subspan(2));
  if (!what)
    return wrong(fmt::format("\"{}\" is no task, or its values are wrong.", given[1]),
                 kTaskUsage);
  return Command(TaskCommand{std::string(given[0]), *std::move(what)});
}

Result<Command> speed(Words given) {
  if (given.size() == 1 && given[0] == "fast") return Command(SpeedCommand{0});
  if (given.size() == 1 && given[0] == "real") return Command(SpeedCommand{1});
  const auto factor = given.size() == 1 ? finite_number(given[0]) : std::nullopt;
  if (!factor || *factor <= 0 || *factor > kMaxSpeedFactor)
    return wrong("a speed is fast, real or a factor above 0.", "Say: speed 10");
  return Command(SpeedCommand{*factor});
}

Result<Command> step(Words given) {
  const auto steps = given.empty() ? std::optional(1) : count(given[0]);
  if (!steps || given.size() > 1)
    return wrong("steps are counted from 1.", "Say: step, or step 10");
  return Command(StepCommand{static_cast<std::uint32_t>(*steps)});
}

Result<Command> wind(Words given) {
  if (given.size() == 1 && given[0] == "off") return Command(WindCommand{});
  const auto strength = given.size() == 2 ? finite_number(given[0]) : std::nullopt;
  const auto from = given.size() == 2 ? finite_number(given[1]) : std::nullopt;
  if (!strength || !from || *strength < 0 || *strength > kMaxWind)
    return wrong(fmt::format("wind needs a speed from 0 to {} m/s and where it comes "
                             "from in degrees.",
                             kMaxWind),
                 "Say: wind 3 270, or wind off");
  return Command(WindCommand{-*strength * geo::unit(geo::radians(*from))});
}

Result<Command> fault(Words given, bool fails) {
  if (given.size() < 2)
    return wrong("which part of which aircraft?", "Say: fault AIRCRAFT sensor imu");
  std::string part(given[1]);
  for (const std::string_view word : given.subspan(2)) part.append(" ").append(word);
  return Command(FaultCommand{std::string(given[0]), std::move(part), fails});
}

Result<Command> mission(Words given) {
  if (given.size() != 1 || (given[0] != "pause" && given[0] != "resume"))
    return wrong("a mission is paused or resumed.", "Say: mission pause");
  return Command(MissionCommand{given[0] == "pause"});
}

// What the types of its fields leave open: empty when it can be obeyed.
struct ValueCheck {
  std::string operator()(const StepCommand& c) {
    return c.steps >= 1 && c.steps <= kMaxCount ? "" : "steps are counted from 1.";
  }
  std::string operator()(const SpeedCommand& c) {
    return c.factor >= 0 && c.factor <= kMaxSpeedFactor
               ? ""
               : "a speed is 0 (as fast as possible) or a factor above 0.";
  }
  std::string operator()(const WindCommand& c) {
    return c.added.norm() <= kMaxWind ? ""
                                      : fmt::format("wind is at most {} m/s.", kMaxWind);
  }
  std::string operator()(const TaskCommand& c) {
    const auto* route = std::get_if<FlyRoute>(&c.what);
    const auto* followed = std::get_if<FollowLine>(&c.what);
    if (route && (route->points.empty() || route->laps < 1))
      return "a route has a point or more, and one lap or more.";
    if (followed && followed->points.size() < 2) return "a line has two points or more.";
    const auto* tour = std::get_if<FlyTour>(&c.what);
    if (tour && (tour->points.size() < 2 || tour->laps < 1))
      return "a tour has two points or more, and one lap or more.";
    return "";
  }
  std::string operator()(const ZoneChange& c) {
    return c.number == 0 ? "" : "the ground station numbers changes, not the operator.";
  }
  std::string operator()(const auto&) { return ""; }
};

// A command as programs write it: an object with its kind and fields.
Result<Command> parse_object(std::string_view line) {
  auto command = json::from_json<Command>(json::Json::parse(line, nullptr, false));
  if (!command) return command.error();
  if (std::string error = std::visit(ValueCheck(), command.value()); !error.empty())
    return wrong(std::move(error), "");
  return command;
}

}  // namespace

Result<Command> parse_command(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin != std::string_view::npos && line[begin] == '{') return parse_object(line);
  const std::vector<std::string_view> all = words::split(line);
  if (all.empty()) return wrong("this is no command.", kUsage);
  const std::string_view verb = all[0];
  const Words given = Words(all).subspan(1);
  if (verb == "zone") {
    auto change = parse_zone_command(line);
    if (!change) return change.error();
    return Command(std::move(change).value());
  }
  if (verb == "task") return task(given);
  if (verb == "mission") return mission(given);
  if (verb == "speed") return speed(given);
  if (verb == "step") return step(given);
  if (verb == "wind") return wind(given);
  if (verb == "fault" || verb == "repair") return fault(given, verb == "fault");
  if ((verb == "pause" || verb == "resume") && given.empty())
    return Command(PauseCommand{verb == "pause"});
  if (verb == "add" && given.size() == 1)
    return Command(AddCommand{std::string(given[0])});
  if (verb == "remove" && given.size() == 1)
    return Command(RemoveCommand{std::string(given[0])});
  return wrong("this is no command.", kUsage);
}

}  // namespace skein
