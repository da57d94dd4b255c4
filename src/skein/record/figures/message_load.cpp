// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/message_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/record/store/record_table.h"

namespace skein::record {
namespace {

// One line of a table: a name, and a number for each phase.
std::string table_line(const std::string& name, const std::vector<double>& values) {
  std::string line = fmt::format("{:<20}", name);
  for (const double value : values) line += fmt::format(" {:>12.1f}", value);
  return line + "\n";
}

// A field of a CSV file.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

Result<SentMessages> read_sent_messages(const std::filesystem::path& directory) {
  auto opened = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!opened) return opened.error();
  Sqlite database = std::move(opened).value();
  if (auto good = check_store(database); !good) return good.error();
  SentMessages run;
  auto done = for_each_row_of(
      database, "entities", "entity_id, name, kind", "", [&](const Statement& row) {
        run.senders[entity_id(row, 1)] = {row.text(2), row.text(3) == "aircraft"};
      });
  if (!done) return done.error();
  constexpr auto kMaxBytes = std::numeric_limits<std::uint32_t>::max();
  done = for_each_row_of(
      database, "messages",
      "sent_s, from_id, CASE content_kind WHEN 'team' THEN said ELSE content_kind END, "
      "size_bytes",
      "WHERE copy = 0 ORDER BY sent_s, from_id, number", [&](const Statement& row) {
        run.messages.push_back({row.seconds(1), entity_id(row, 2), row.text(3),
                                static_cast<std::uint32_t>(row.whole(4, 0, kMaxBytes))});
      });
  if (!done) return done.error();
  if (run.messages.empty())
    return Error{ErrorCode::kBadInput, directory.string(), "the run has no messages.",
                 "Let it record them: record.messages."};
  done = for_each_row(
      database,
      "SELECT max(coalesce((SELECT max(time_s) FROM truth), 0),"
      " coalesce((SELECT max(sent_s) FROM messages), 0),"
      " coalesce((SELECT max(value) FROM summary WHERE name = 'simulated_s'), 0)) AS "
      "end_s",
      [&](const Statement& row) {
        run.duration = row.real(0);
        if (run.duration < 0 || run.duration > kLongestRun)
          row.refuse(0, "the end of a run, from 0 to 4e6 s");
      },
      "tables truth, messages and summary");
  if (!done) return done.error();
  return run;
}

Result<std::vector<LoadPhase>> load_phases(
    const std::vector<std::pair<std::string, double>>& starts, double end) {
  std::vector<LoadPhase> phases;
  if (starts.empty()) {
    phases.push_back({"all", 0, end});
    return phases;
  }
  if (starts.front().second > 0) phases.push_back({"before", 0, 0});
  for (const auto& [name, from] : starts) {
    const double last = phases.empty() ? -1 : phases.back().from;
    if (!std::isfinite(from) || from < 0 || from <= last || from >= end)
      return Error{ErrorCode::kBadInput, name,
                   fmt::format("{} s is no begin of a phase: times ascend, from 0 to the "
                               "end of the run at {} s.",
                               from, end),
                   ""};
    if (!phases.empty()) phases.back().until = from;
    phases.push_back({name, from, end});
  }
  return phases;
}

void MessageLoad::add(const SentMessage& message) {
  const auto phase = std::ranges::find_if(phases_, [&](const LoadPhase& each) {
    return each.from <= message.time && message.time < each.until;
  });
  if (phase == phases_.end()) return;
  const auto index = static_cast<std::size_t>(phase - phases_.begin());
  Sum& sum = sums_[{index, message.from, message.kind}];
  ++sum.messages;
  sum.bytes += message.bytes + header_;
}

double MessageLoad::rate(std::size_t phase, const Sum& sum) const {
  const LoadPhase& during = phases_[phase];
  return static_cast<double>(sum.bytes) / (during.until - during.from);
}

std::string message_load_csv(const MessageLoad& load, const SentMessages& run) {
  std::string csv = "phase,from_s,until_s,entity,kind,messages,bytes,bytes_per_s\n";
  for (const auto& [key, sum] : load.sums()) {
    const auto& [phase, from, kind] = key;
    const LoadPhase& during = load.phases()[phase];
    const auto sender = run.senders.find(from);
    csv +=
        fmt::format("{},{},{},{},{},{},{},{:.2f}\n", csv_field(during.name), during.from,
                    during.until,
                    csv_field(sender == run.senders.end() ? fmt::format("{}", from.value)
                                                          : sender->second.name),
                    kind, sum.messages, sum.bytes, load.rate(phase, sum));
  }
  return csv;
}

std::string message_load_text(const MessageLoad& load, const SentMessages& run) {
  const std::size_t phases = load.phases().size();
  std::map<std::string, std::vector<double>> by_kind;
  std::vector<double> of_aircraft(phases), of_stations(phases), together(phases);
  for (const auto& [key, sum] : load.sums()) {
    const auto& [phase, from, kind] = key;
    const double rate = load.rate(phase, sum);
    together[phase] += rate * 8e-3;
    const auto sender = run.senders.find(from);
    if (sender == run.senders.end() || !sender->second.is_aircraft) {
      of_stations[phase] += rate;
      continue;
    }
    auto [line, is_new] = by_kind.try_emplace(kind, phases);
    line->second[phase] += rate;
    of_aircraft[phase] += rate;
  }
  const auto aircraft = static_cast<double>(std::ranges::count_if(
      run.senders, [](const auto& sender) { return sender.second.is_aircraft; }));
  const auto mean = [&](std::vector<double> values) {
    for (double& value : values) value /= std::max(1.0, aircraft);
    return values;
  };
  std::string text =
      fmt::format("bytes/s of an aircraft, mean of {}\n{:<20}", aircraft, "kind");
  for (const LoadPhase& phase : load.phases()) text += fmt::format(" {:>12}", phase.name);
  text += "\n";
  std::vector<double> lengths;
  for (const LoadPhase& phase : load.phases())
    lengths.push_back(phase.until - phase.from);
  for (const auto& [kind, values] : by_kind) text += table_line(kind, mean(values));
  text += table_line("all kinds", mean(of_aircraft));
  text += table_line("all stations", of_stations);
  text += table_line("together, kbit/s", together);
  return text + table_line("seconds", lengths);
}

}  // namespace skein::record
