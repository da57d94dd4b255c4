// SPDX-License-Identifier: Apache-2.0
#include "skein/data/command/command_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "skein/base/valid_text.h"
#include "skein/data/airspace/zone_command.h"
#include "skein/data/describe/json.h"
#include "skein/data/describe/words.h"
#include "skein/data/team/task_text.h"

namespace skein {
namespace {

using Words = std::span<const std::string_view>;

constexpr double kMaxSpeedFactor = 1e9;
constexpr double kMaxWind = 100;       // [m/s]
constexpr double kMaxHeight = 20000;   // [m]
constexpr double kMaxAirspeed = 1000;  // [m/s]
constexpr double kMaxCount = 1e6;
constexpr std::size_t kMaxBefore = 100;  // tasks that one comes after

Error wrong(std::string message, std::string usage) {
  return {ErrorCode::kBadInput, "", std::move(message), std::move(usage)};
}

constexpr const char* kUsage =
    "Commands: zone, task, team, flight, mission, allocation, pause, resume, step, "
    "speed, fault, repair, wind, add, remove, hand-back.";
std::string task_hint(const TaskForms& forms) {
  std::string hint = "Say: task AIRCRAFT pause, resume, cancel, give AIRCRAFT";
  for (const TaskForm& form : forms.all()) hint += "; " + form.usage;
  return hint + ".";
}

std::optional<double> finite_number(std::string_view word) {
  const auto value = words::number(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// A count from 1 on.
std::optional<int> count(std::string_view word) {
  const auto value = finite_number(word);
  if (!value || *value < 1 || *value > kMaxCount || *value != std::floor(*value))
    return std::nullopt;
  return static_cast<int>(*value);
}

// An order about the task that an aircraft has.
std::optional<TaskChangeCommand> task_change(Words given) {
  const std::string aircraft(given[0]);
  for (const TaskAction action :
       {TaskAction::kPause, TaskAction::kResume, TaskAction::kCancel})
    if (given.size() == 2 && given[1] == name_of(action))
      return TaskChangeCommand{aircraft, action, {}};
  if (given.size() == 3 && given[1] == "give")
    return TaskChangeCommand{aircraft, TaskAction::kCancel, std::string(given[2])};
  return std::nullopt;
}

Result<Command> task(Words given, const TaskForms& forms) {
  if (given.size() < 2)
    return wrong("a task needs an aircraft and a kind.", task_hint(forms));
  if (auto change = task_change(given)) return Command(*std::move(change));
  auto text = parse_task(given[1], given.subspan(2), forms);
  if (!text) return wrong(text.error().message, task_hint(forms));
  TaskText& said = text.value();
  return Command(TaskCommand{std::string(given[0]), std::move(said.what),
                             std::move(said.others), std::move(said.file)});
}

std::string flight_error(const FlightChangeCommand& command) {
  const auto within = [](std::optional<double> value, double max) {
    return !value || (*value > 0 && *value <= max);
  };
  if (!command.altitude_agl && !command.airspeed) return "how high, or how fast?";
  if (!within(command.altitude_agl, kMaxHeight))
    return fmt::format("a height is above 0 and at most {} m.", kMaxHeight);
  if (!within(command.airspeed, kMaxAirspeed))
    return fmt::format("an airspeed is above 0 and at most {} m/s.", kMaxAirspeed);
  return "";
}

Result<Command> flight(Words given) {
  const std::string usage = "Say: flight AIRCRAFT height 150, or speed 18, or both";
  if (given.size() != 3 && given.size() != 5)
    return wrong("how high, or how fast, shall which aircraft fly?", usage);
  FlightChangeCommand command{std::string(given[0])};
  for (std::size_t k = 1; k < given.size(); k += 2) {
    const bool is_height = given[k] == "height";
    std::optional<double>& value = is_height ? command.altitude_agl : command.airspeed;
    if ((!is_height && given[k] != "speed") || value)
      return wrong("a height and a speed can be given.", usage);
    value = finite_number(given[k + 1]);
    if (!value) return wrong(fmt::format("\"{}\" is no number.", given[k + 1]), usage);
  }
  if (std::string error = flight_error(command); !error.empty())
    return wrong(std::move(error), usage);
  return Command(std::move(command));
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
  for (const MissionAction action : {MissionAction::kPause, MissionAction::kResume,
                                     MissionAction::kStart, MissionAction::kEnd})
    if ((given.size() == 1 || given.size() == 2) && given[0] == name_of(action))
      return Command(MissionCommand{
          action, given.size() == 2 ? std::string(given[1]) : std::string()});
  return wrong("a mission is paused, resumed, started or ended.",
               "Say: mission pause, or mission pause NAME; resume, start, end.");
}

Result<Command> allocation(Words given) {
  const auto refuse = [] {
    return wrong(
        "a proposed allocation is approved or rejected, by its number from 1 on.",
        "Say: allocation approve, or allocation approve 3; reject; then the "
        "station where there are several.");
  };
  if (given.empty() || given.size() > 3) return refuse();
  AllocationCommand command;
  if (given[0] == name_of(AllocationAction::kReject))
    command.action = AllocationAction::kReject;
  else if (given[0] != name_of(AllocationAction::kApprove))
    return refuse();
  if (given.size() == 1) return Command(command);
  const auto number = count(given[1]);
  if (!number) return refuse();
  command.number = static_cast<std::uint32_t>(*number);
  if (given.size() == 3) command.station = std::string(given[2]);
  return Command(std::move(command));
}

// "3,4": numbers of tasks.
std::optional<std::vector<std::uint32_t>> task_numbers(std::string_view word) {
  std::vector<std::uint32_t> numbers;
  for (;;) {
    const std::size_t comma = word.find(',');
    const auto number = count(word.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(static_cast<std::uint32_t>(*number));
    if (comma == std::string_view::npos) return numbers;
    word.remove_prefix(comma + 1);
  }
}

std::string team_task_error(const TeamTaskCommand& command, const TaskForms& forms) {
  if (command.action != TeamTaskAction::kAdd && command.number == 0)
    return "tasks are numbered from 1.";
  if (command.after.size() > kMaxBefore)
    return fmt::format("a task comes after {} others at most.", kMaxBefore);
  if (command.action != TeamTaskAction::kAdd && (!command.after.empty() || command.group))
    return "what a task comes after, and for how many it is, is said when it is added.";
  if (command.action != TeamTaskAction::kWithdraw &&
      std::holds_alternative<Hold>(command.what))
    return "what is to be done? To hold where it is, is for one aircraft.";
  // Names become numbers later.
  const bool is_open =
      command.action == TeamTaskAction::kWithdraw || !command.others.empty();
  return is_open ? "" : forms.error(command.what);
}

Result<Command> team(Words given, const TaskForms& forms) {
  const auto refuse = [](std::string why) {
    return wrong(std::move(why),
                 "Say: team add survey ..., or team add after 1,2 group survey ...; "
                 "team withdraw 3; team change 3 survey ...; where there are several "
                 "stations: team of STATION add ...");
  };
  TeamTaskCommand command;
  if (given.size() > 2 && given[0] == "of") {
    command.station = std::string(given[1]);
    given = given.subspan(2);
  }
  std::optional<TeamTaskAction> action;
  for (const TeamTaskAction each :
       {TeamTaskAction::kAdd, TeamTaskAction::kWithdraw, TeamTaskAction::kChange})
    if (!given.empty() && given[0] == name_of(each)) action = each;
  if (!action) return refuse("a task of a team is added, withdrawn or changed.");
  command.action = *action;
  given = given.subspan(1);
  if (command.action != TeamTaskAction::kAdd) {
    const auto number = given.empty() ? std::nullopt : count(given[0]);
    if (!number) return refuse("which task? They are numbered from 1.");
    command.number = static_cast<std::uint32_t>(*number);
    given = given.subspan(1);
  } else {
    if (given.size() > 1 && given[0] == "after") {
      auto numbers = task_numbers(given[1]);
      if (!numbers) return refuse("tasks that come before are numbers from 1 on.");
      command.after = std::move(*numbers);
      given = given.subspan(2);
    }
    if (!given.empty() && given[0] == "group") {
      command.group = true;
      given = given.subspan(1);
    }
  }
  if (command.action == TeamTaskAction::kWithdraw) {
    if (!given.empty()) return refuse("a task is withdrawn by its number alone.");
    return Command(std::move(command));
  }
  if (given.empty()) return refuse("what is to be done?");
  auto text = parse_task(given[0], given.subspan(1), forms);
  if (!text) return refuse(text.error().message);
  if (!text.value().file.empty())
    return refuse("a plan from a file is for one aircraft.");
  command.what = std::move(text.value().what);
  command.others = std::move(text.value().others);
  if (std::string error = team_task_error(command, forms); !error.empty())
    return refuse(std::move(error));
  return Command(std::move(command));
}

// What the types of its fields leave open: empty when it can be obeyed.
struct ValueCheck {
  const TaskForms& forms;

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
    // Names become numbers, and files plans, later.
    if (!c.others.empty() || !c.file.empty()) return "";
    const auto* followed = std::get_if<FollowLine>(&c.what);
    if (followed && followed->points.size() < 2) return "a line has two points or more.";
    return forms.error(c.what);
  }
  std::string operator()(const ZoneChange& c) {
    return c.number == 0 ? "" : "the ground station numbers changes, not the operator.";
  }
  std::string operator()(const FlightChangeCommand& c) { return flight_error(c); }
  std::string operator()(const TeamTaskCommand& c) { return team_task_error(c, forms); }
  std::string operator()(const auto&) { return ""; }
};

// Has the task of a command, of a kind without a type in messages, as it travels.
Result<void> name_task(json::Json& command, const TaskForms& forms) {
  if (!command.is_object()) return {};
  const auto what = command.find("what");
  if (what == command.end() || !what->is_object()) return {};
  const auto kind = what->find("kind");
  if (kind == what->end() || !kind->is_string()) return {};
  const TaskForm* form = forms.find(kind->get<std::string>());
  if (!form || message_task_forms().find(form->kind)) return {};
  const auto task = form->from_json(*what);
  if (!task) return task.error();
  json::Json named{{"kind", kind_of<NamedTask>()}};
  named.update(json::to_json(std::get<NamedTask>(task.value())));
  *what = std::move(named);
  return {};
}

// A command as programs write it: an object with its kind and fields.
Result<Command> parse_object(std::string_view line, const TaskForms& forms) {
  json::Json object = json::Json::parse(line, nullptr, false);
  if (const auto named = name_task(object, forms); !named) return named.error();
  auto command = json::from_json<Command>(object);
  if (!command) return command.error();
  if (std::string error = std::visit(ValueCheck{forms}, command.value()); !error.empty())
    return wrong(std::move(error), "");
  return command;
}

Result<Command> parse_valid(std::string_view line, const TaskForms& forms) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin != std::string_view::npos && line[begin] == '{')
    return parse_object(line, forms);
  const std::vector<std::string_view> all = words::split(line);
  if (all.empty()) return wrong("this is no command.", kUsage);
  const std::string_view verb = all[0];
  const Words given = Words(all).subspan(1);
  if (verb == "zone") {
    auto change = parse_zone_command(line);
    if (!change) return change.error();
    return Command(std::move(change).value());
  }
  if (verb == "task") return task(given, forms);
  if (verb == "team") return team(given, forms);
  if (verb == "flight") return flight(given);
  if (verb == "mission") return mission(given);
  if (verb == "allocation") return allocation(given);
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
  if (verb == "hand-back" && given.size() == 1)
    return Command(HandBackCommand{std::string(given[0])});
  return wrong("this is no command.", kUsage);
}

}  // namespace

Result<Command> parse_command(std::string_view line, const TaskForms& forms) {
  return is_valid_text(line) ? parse_valid(line, forms)
                             : parse_valid(valid_text(line), forms);
}

}  // namespace skein
