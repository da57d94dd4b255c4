#pragma once

// Whole aircraft fly in a scenario, from plant to autopilot, and everything that a run
// tells its recorder is kept in memory.

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "skein/assemble/build.h"
#include "skein/assemble/kinds_of.h"
#include "skein/record/content_hash.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/run.h"

namespace skein::assemble {

/// One record of an aircraft: what was true, what it believed, and what it did.
struct FlightRow {
  Time time;
  VehicleState truth;
  NavEstimate nav;
  AutopilotStatus status;

  double altitude() const { return -truth.p_N.z(); }
  geo::Euler attitude() const { return geo::to_euler(truth.q_NB); }
};

/// Everything that was recorded.
class FlightLog final : public Recorder {
 public:
  void record(const Record& record) override {
    hash_->add(record);
    if (const auto* t = std::get_if<TruthRecord>(&record))
      rows[t->id.value].push_back({t->time, t->state, {}, {}});
    if (const auto* e = std::get_if<EstimateRecord>(&record)) {
      FlightRow& row = rows[e->id.value].back();
      row.nav = e->nav;
      row.status = e->status;
      row.status.refused = {};  // good until the next one only
    }
    if (const auto* e = std::get_if<Event>(&record)) events.push_back(*e);
    if (const auto* d = std::get_if<Detection>(&record)) detections.push_back(*d);
    if (const auto* s = std::get_if<RangeScan>(&record)) scans.push_back(*s);
  }

  std::string hash() const { return hash_->hex(); }
  /// The first event of that kind and text (empty: any); null when there is none.
  const Event* find(const std::string& kind, const std::string& text = "") const {
    for (const Event& event : events)
      if (event.kind == kind && (text.empty() || event.text == text)) return &event;
    return nullptr;
  }
  /// All events in words, for messages of tests.
  std::string story() const {
    std::string all;
    for (const Event& e : events)
      all += std::to_string(e.time.seconds()) + " s, " + std::to_string(e.entity.value) +
             ": " + e.kind + ": " + e.text + "\n";
    return all;
  }

  std::map<std::uint32_t, std::vector<FlightRow>> rows;  ///< by entity
  std::vector<Event> events;
  std::vector<Detection> detections;
  std::vector<RangeScan> scans;

 private:
  // Its own, so that a log can be moved.
  std::unique_ptr<record::ContentHash> hash_ = std::make_unique<record::ContentHash>();
};

/// Commands one after the other.
class ScriptedAgent final : public Agent {
 public:
  struct Line {
    AutopilotCommand command;
    double at = 0;           ///< not before [s]
    bool when_done = false;  ///< and not before the last one is done
  };
  explicit ScriptedAgent(std::vector<Line> lines) : lines_(std::move(lines)) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    if (next_ >= lines_.size()) return;
    const Line& line = lines_[next_];
    // The step after a command shows the status of that command.
    if (in.now.seconds() < line.at || (line.when_done && !in.autopilot.done)) return;
    out.command = line.command;
    ++next_;
  }

 private:
  std::vector<Line> lines_;
  std::size_t next_ = 0;
};

class NoConsole final : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return false; }
};

/// How a scenario is run by a test.
struct Flown {
  std::vector<ScriptedAgent::Line> script =
      {};  ///< of every aircraft; empty: its own agent
  int threads = 1;
  double speed = 0;
};

/// Runs a scenario given as text. What is wrong with it is an exception: the test fails.
inline FlightLog fly(const std::string& text, const Flown& how = {}) {
  const auto read =
      scenario::read_scenario_text(text, "flight", SKEIN_SOURCE_DIR, kind_table());
  if (!read.ok()) throw std::runtime_error(read.report());
  auto built = build(*read.scenario, KindRegistry());
  if (!built) throw std::runtime_error(built.error().text());
  if (!how.script.empty())
    for (simulation::Entity& entity : built.value().world.entities)
      if (entity.vehicle) entity.agent = std::make_unique<ScriptedAgent>(how.script);
  built.value().options.threads = how.threads;
  built.value().options.speed = how.speed;
  FlightLog log;
  NoConsole console;
  const auto outcome =
      simulation::run(built.value().world, built.value().options, log, console);
  if (!outcome) throw std::runtime_error(outcome.error().text());
  return log;
}

/// Root of the mean square and largest size of some numbers.
struct Spread {
  double square = 0, most = 0;
  int count = 0;
  void add(double x) {
    square += x * x;
    most = std::max(most, std::abs(x));
    ++count;
  }
  double rms() const { return count > 0 ? std::sqrt(square / count) : NAN; }
};

}  // namespace skein::assemble
