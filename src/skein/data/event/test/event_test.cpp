// SPDX-License-Identifier: Apache-2.0
#include "skein/data/event/event.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "skein/data/describe/columns.h"
#include "skein/data/describe/json.h"
#include "skein/data/describe/wire.h"

namespace skein::event_test {
namespace {

std::vector<EventKindRow> all_rows() {
  std::vector<EventKindRow> rows;
  for (const EventGroup& group : event_groups())
    rows.insert(rows.end(), group.rows.begin(), group.rows.end());
  return rows;
}

template <class T>
std::vector<std::byte> coded(const T& value) {
  std::vector<std::byte> bytes;
  wire::encode(value, bytes);
  return bytes;
}

TEST(EventKinds, EachHasARowInItsPlace) {
  const auto rows = all_rows();
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(EventKind::kPlugin) + 1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto kind = static_cast<EventKind>(k);
    EXPECT_EQ(rows[k].kind, kind) << rows[k].name;
    EXPECT_EQ(row_of(kind).name, rows[k].name);
  }
  EXPECT_EQ(subject_of(EventKind::kJoined), EventSubject::kFlight);
  EXPECT_EQ(subject_of(EventKind::kTeamAnswerRefused), EventSubject::kProtocol);
  EXPECT_EQ(subject_of(EventKind::kPlugin), EventSubject::kPlugin);
}

// Names are in databases and scripts; the texts in docs/events.md and on pages.
TEST(EventKinds, HaveNamesOfTheirOwnAndOneSentence) {
  std::set<std::string_view> names;
  for (const EventKindRow& row : all_rows()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second);
    EXPECT_FALSE(row.name.empty());
    EXPECT_TRUE(std::ranges::all_of(
        row.name, [](char c) { return c == '-' || (c >= 'a' && c <= 'z'); }));
    ASSERT_GT(row.meaning.size(), 10u);
    EXPECT_TRUE(row.meaning[0] >= 'A' && row.meaning[0] <= 'Z');
    EXPECT_EQ(row.meaning.back(), '.');
    EXPECT_EQ(row.meaning.find_first_of("\"|\n"), std::string_view::npos);
    EXPECT_EQ(EventLabel::named(row.name), row.kind);
    EXPECT_EQ(EventLabel(row.kind).name(), row.name);
  }
}

TEST(EventKinds, WhoCommandsIsShownAtOnceWhatCannotWait) {
  std::set<std::string_view> announced;
  for (const EventKindRow& row : all_rows())
    if (is_announced({Time(), EntityId{}, row.kind, ""})) announced.insert(row.name);
  EXPECT_EQ(announced, (std::set<std::string_view>{
                           "traffic-alert", "clear-of-traffic", "recommended",
                           "allocation-proposed", "allocation-over", "wrong-vehicle",
                           "wrong-place", "not-heard", "take-off-denied",
                           "not-commandable", "not-brought-back", "separation-lost"}));
}

// What pages colour, and viewers show as warnings.
TEST(EventKinds, WhatFailsIsAWarningAndWhatIsLostAnAlarm) {
  for (const EventKind kind :
       {EventKind::kAccident, EventKind::kWrongVehicle, EventKind::kWrongPlace,
        EventKind::kNotCommandable, EventKind::kNotBroughtBack})
    EXPECT_EQ(row_of(kind).severity, EventSeverity::kAlarm) << row_of(kind).name;
  for (const EventKindRow& row : all_rows()) {
    if (row.severity >= EventSeverity::kWarning) continue;
    // An object of the memory, what a pilot has taken over, and what is of a study.
    const bool is_plain = row.kind == EventKind::kUpdateRefused ||
                          row.kind == EventKind::kEdgeLost ||
                          row.kind == EventKind::kNeighbourLost;
    for (const char* bad : {"refused", "denied", "lost", "wrong", "failure", "failsafe"})
      EXPECT_TRUE(is_plain || row.name.find(bad) == std::string_view::npos) << row.name;
  }
}

TEST(EventLabel, OfAPluginKeepsItsOwnName) {
  const EventLabel own = EventLabel::named("my-kinds-smoke");
  EXPECT_EQ(own, EventKind::kPlugin);
  EXPECT_EQ(own.name(), "my-kinds-smoke");
  EXPECT_NE(own, EventLabel::named("my-kinds-fire"));
  EXPECT_EQ(EventLabel::named("plugin"), EventLabel(EventKind::kPlugin));
}

TEST(EventLabel, NamesOfEarlierVersionsAreThoseOfNow) {
  EXPECT_EQ(EventLabel::named("arming-denied"), EventKind::kTakeOffDenied);
}

TEST(Event, TravelsByTheNameOfItsKind) {
  for (const EventLabel& kind :
       {EventLabel(EventKind::kTeamTask), EventLabel::named("other-smoke")}) {
    const Event event{Time::from_seconds(3),
                      EntityId{2},
                      kind,
                      "3: measure",
                      {.other = EntityId{4}, .team_task = 3, .value = 0.5}};
    const auto back = wire::decode<Event>(coded(event));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(back.value().kind, kind);
    EXPECT_EQ(back.value().text, event.text);
    EXPECT_EQ(back.value().numbers, event.numbers);
    const auto json = json::to_json(event);
    EXPECT_EQ(json.at("kind"), kind.name());
    EXPECT_EQ(json.at("team_task"), 3);
    EXPECT_TRUE(json.at("threshold").is_null());
    const auto read = json::from_json<Event>(json);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value().kind, kind);
    EXPECT_EQ(read.value().numbers, event.numbers);
  }
}

// As events were before they had kinds and numbers: their bytes, which earlier programs
// send and read, and the content hash count on that.
struct NamedEvent {
  Time time;
  EntityId entity;
  std::string kind, text;
};
constexpr auto describe(const NamedEvent*) {
  using T = NamedEvent;
  return described<T>({"event", "events"}, "", field("time", &T::time, ""),
                      field("entity_id", &T::entity, ""), field("kind", &T::kind, ""),
                      field("text", &T::text, ""));
}

TEST(Event, HasTheBytesOfItsNameAndText) {
  const NamedEvent before{Time::from_seconds(7), EntityId{300}, "task-done", "task 1: x"};
  const Event event{
      before.time, before.entity, EventKind::kTaskDone, before.text, {.task = 1}};
  std::vector<std::byte> hashed, hashed_before;
  wire::encode_canonical(event, hashed);
  wire::encode_canonical(before, hashed_before);
  EXPECT_EQ(hashed, hashed_before);
  const auto read = wire::decode<NamedEvent>(coded(event));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().kind, "task-done");
  const auto older = wire::decode<Event>(coded(before));
  ASSERT_TRUE(older.ok());
  EXPECT_EQ(older.value().kind, EventKind::kTaskDone);
  EXPECT_EQ(older.value().numbers, EventNumbers());
}

TEST(Event, HasColumnsForItsNumbers) {
  std::vector<std::string> names;
  for (const columns::Column& column : columns::columns_of<Event>())
    names.push_back(column.name + " " + std::string(column.type));
  EXPECT_EQ(names, (std::vector<std::string>{"time_s REAL", "entity_id INTEGER",
                                             "kind TEXT", "text TEXT", "other_id INTEGER",
                                             "task INTEGER", "team_task INTEGER",
                                             "value REAL", "threshold REAL"}));
}

}  // namespace
}  // namespace skein::event_test
