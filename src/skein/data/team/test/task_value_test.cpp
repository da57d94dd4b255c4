// SPDX-License-Identifier: Apache-2.0
// Tasks of kinds that messages have no type for.
#include "skein/data/team/task_value.h"

#include <gtest/gtest.h>

#include <limits>

#include "skein/data/command/command_text.h"
#include "skein/data/team/task_form_of.h"
#include "skein/data/team/task_text.h"

namespace skein::task_value_test {
namespace {

// Circles around another, at a place that is shown to it first.
struct Escort {
  EntityId whom;
  Vec2 meeting = Vec2::Zero();
  double radius = 50;
  double side = 0;  // [rad]
  Time wait = Time();
};
constexpr auto describe(const Escort*) {
  using T = Escort;
  return described<T>({"escort"}, "Circle another.", field("whom_id", &T::whom, "whom"),
                      field("", &T::meeting, axes::kPlace, "where they meet"),
                      field("radius", &T::radius, unit::kMetre, "of the circle"),
                      field("side", &T::side, unit::kDegree, "where it begins"),
                      field("wait", &T::wait, "before"));
}
std::string check_task(const Escort& task) {
  return task.radius > 0 ? "" : "the radius must be above 0 m.";
}

// Says nothing of itself but its values.
struct Wave {
  std::vector<Vec2> line;
  int times = 3;
};
constexpr auto describe(const Wave*) {
  using T = Wave;
  return described<T>({"wave"}, "Rock the wings.",
                      field("line", &T::line, Storage::kJson, "along it"),
                      field("times", &T::times, "how often"));
}

TaskForms forms() {
  TaskForms all = message_task_forms();
  all.add(task_form_of<Escort>());
  all.add(task_form_of<Wave>());
  return all;
}

template <class T>
T sent(const T& value) {
  std::vector<std::byte> bytes;
  wire::encode(value, bytes);
  return wire::decode<T>(bytes).value();
}

TEST(TaskValue, TravelsByTheNameOfItsKind) {
  const Escort escort{EntityId{7}, {100, -20}, 80, 0.3, Time::from_seconds(2.5)};
  const Task received = sent(Task{3, as_task(escort)});
  EXPECT_EQ(kind_of(received.what), "escort");
  const auto values = task_as<Escort>(received.what);
  ASSERT_TRUE(values);
  EXPECT_EQ(values->whom, EntityId{7});
  EXPECT_EQ(values->meeting, Vec2(100, -20));
  EXPECT_EQ(values->side, 0.3);  // no degrees between
  EXPECT_EQ(values->wait, escort.wait);
  EXPECT_FALSE(task_as<Wave>(received.what));
  EXPECT_FALSE(task_as<FlyTo>(received.what));
  EXPECT_EQ(task_as<FlyTo>(as_task(FlyTo{{1, 2}}))->point, Vec2(1, 2));
}

TEST(TaskValue, SaysToWhoDoesNotKnowItsKindWhatItTakes) {
  const TaskKind escort = sent(Task{1, as_task(Escort{EntityId{7}, {100, -20}})}).what;
  EXPECT_EQ(needs_of(escort).begin, Vec2(100, -20));
  EXPECT_FALSE(needs_of(escort).foreseen);
  EXPECT_EQ(others_of(escort), std::vector{EntityId{7}});
  const TaskNeeds wave = needs_of(as_task(Wave{{{5, 6}, {7, 8}}}));
  EXPECT_EQ(wave.begin, Vec2(5, 6));
  EXPECT_TRUE(wave.foreseen);
  EXPECT_FALSE(needs_of(as_task(Wave{})).begin);
}

TEST(TaskValue, IsBoundToOthersByWhoDoesNotKnowItsKind) {
  TaskKind task = as_task(Escort{});
  bind_others(task, std::vector{EntityId{3}, EntityId{4}});
  EXPECT_EQ(task_as<Escort>(task)->whom, EntityId{}) << "it is about one";
  bind_others(task, std::vector{EntityId{3}});
  EXPECT_EQ(task_as<Escort>(task)->whom, EntityId{3});
}

TEST(TaskValue, WhatComesFromOutsideIsChecked) {
  NamedTask task = std::get<NamedTask>(as_task(Escort{}));
  EXPECT_EQ(task_error(task), "");
  EXPECT_EQ(forms().error(task), "");
  task.needs.begin = Vec2(std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_NE(task_error(task), "");
  task = std::get<NamedTask>(as_task(Escort{}));
  task.coded.resize(task.coded.size() / 2);
  EXPECT_NE(forms().error(task), "");
  EXPECT_NE(forms().error(as_task(Escort{EntityId{1}, {0, 0}, -1})), "");
  EXPECT_NE(forms().error(as_task(
                Escort{EntityId{1}, {0, std::numeric_limits<double>::infinity()}})),
            "");
  EXPECT_NE(message_task_forms().error(as_task(Escort{})), "") << "nobody knows it";
  EXPECT_NE(task_error(NamedTask{}), "");
}

TEST(TaskValue, IsWrittenByItsDescription) {
  const auto text = parse_task("escort uav-2 100,-20 radius 80 side 90", forms());
  ASSERT_TRUE(text.ok()) << text.error().text();
  EXPECT_EQ(text.value().others, std::vector<std::string>{"uav-2"});
  const auto values = task_as<Escort>(text.value().what);
  EXPECT_EQ(values->radius, 80);
  EXPECT_DOUBLE_EQ(values->side, geo::radians(90));
  EXPECT_EQ(forms().find("escort")->usage,
            "escort AIRCRAFT NORTH,EAST [radius m] [side deg] [wait s]");
  for (const char* wrong : {"escort uav-2", "escort 0,0", "wave", "wave 0,0 1,1 often",
                            "escort uav-2 0,0 radius x", "dance 0,0", ""})
    EXPECT_FALSE(parse_task(wrong, forms())) << wrong;
  EXPECT_FALSE(parse_task("escort uav-2 100,-20", message_task_forms()));
}

TEST(TaskValue, IsACommandInWordsAndInJson) {
  const TaskForms all = forms();
  for (
      const char* line :
      {"task uav-1 wave 10,20 30,40 times 5",
       R"({"kind": "task", "aircraft": "uav-1", "what": {"kind": "wave", "line": [[10, 20], [30, 40]], "times": 5}})"}) {
    const auto command = parse_command(line, all);
    ASSERT_TRUE(command.ok()) << line << command.error().text();
    const auto values = task_as<Wave>(std::get<TaskCommand>(command.value()).what);
    ASSERT_TRUE(values) << line;
    EXPECT_EQ(values->times, 5);
    EXPECT_EQ(values->line.at(1), Vec2(30, 40));
    // As it is recorded and given again.
    const auto again = parse_command(json::line_of(json::to_json(command.value())), all);
    ASSERT_TRUE(again.ok()) << again.error().text();
    EXPECT_EQ(task_as<Wave>(std::get<TaskCommand>(again.value()).what)->times, 5);
    EXPECT_FALSE(parse_command(line)) << "without its form";
  }
  EXPECT_TRUE(parse_command("team add wave 10,20 30,40", all));
  for (const char* wrong :
       {R"({"kind": "task", "aircraft": "a", "what": {"kind": "wave", "times": "x"}})",
        R"({"kind": "task", "aircraft": "a", "what": {"kind": "dance"}})",
        R"({"kind": "task", "aircraft": "a", "what": {"kind": 3}})",
        R"({"kind": "task", "aircraft": "a", "what": 3})"})
    EXPECT_FALSE(parse_command(wrong, all)) << wrong;
}

TEST(TaskForms, APageAsksForWhatAKindTakes) {
  const auto form = forms().find("escort")->page_form();
  EXPECT_EQ(form["kind"], "escort");
  ASSERT_EQ(form["fields"].size(), 5U);
  EXPECT_EQ(form["fields"][0]["type"], "aircraft");
  EXPECT_EQ(form["fields"][1]["type"], "place");
  EXPECT_EQ(form["fields"][2]["name"], "radius_m");
  EXPECT_EQ(form["fields"][2]["default"], 50);
}

// What every kind of Skein's own has, too.
TEST(TaskForms, AllKindsOfMessagesHaveOne) {
  EXPECT_EQ(message_task_forms().all().size(), std::variant_size_v<TaskKind> - 1);
  for (const TaskForm& form : message_task_forms().all()) {
    EXPECT_EQ(kind_of(form.plain), form.kind);
    EXPECT_EQ(message_task_forms().find(form.kind), &form);
    EXPECT_TRUE(form.usage.starts_with(short_kind(form.kind))) << form.usage;
  }
  EXPECT_EQ(message_task_forms().find("route")->kind, "fly_route");
}

}  // namespace
}  // namespace skein::task_value_test
