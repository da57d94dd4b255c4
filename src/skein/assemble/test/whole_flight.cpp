// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/test/whole_flight.h"

#include <stdexcept>
#include <utility>
#include <variant>

#include "skein/assemble/world/build.h"
#include "skein/record/figures/statistics.h"
#include "skein/record/store/content_hash.h"
#include "skein/role/agent.h"
#include "skein/role/vehicle.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/run.h"

namespace skein::assemble {
namespace {

class ScriptedAgent final : public Agent {
 public:
  explicit ScriptedAgent(std::vector<ScriptLine> lines) : lines_(std::move(lines)) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    if (next_ >= lines_.size()) return;
    const ScriptLine& line = lines_[next_];
    // The step after a command shows the status of that command.
    if (in.now.seconds() < line.at || (line.when_done && !in.autopilot.done)) return;
    out.command = line.command;
    ++next_;
  }

 private:
  std::vector<ScriptLine> lines_;
  std::size_t next_ = 0;
};

}  // namespace

FlightLog::FlightLog()
    : hash_(std::make_unique<record::ContentHash>()),
      statistics_(std::make_unique<record::RunStatistics>()) {}
FlightLog::FlightLog(FlightLog&&) noexcept = default;
FlightLog::~FlightLog() = default;

void FlightLog::record(const Record& record) {
  hash_->add(record);
  statistics_->take(record);
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
  if (const auto* m = std::get_if<ObjectMotion>(&record)) motions.push_back(*m);
  if (const auto* m = std::get_if<TrafficMotion>(&record)) traffic_motions.push_back(*m);
  if (const auto* b = std::get_if<TrafficBeliefRecord>(&record))
    traffic_beliefs.push_back(*b);
  if (const auto* f = std::get_if<Footprint>(&record)) footprints.push_back(*f);
}

std::string FlightLog::hash() const {
  return hash_->hex();
}

double FlightLog::figure(const std::string& name) const {
  const auto figures = statistics_->figures();
  const auto found = figures.find(name);
  return found == figures.end() ? NAN : found->second;
}

const Event* FlightLog::find(EventKind kind, const std::string& text) const {
  for (const Event& event : events)
    if (event.kind == kind && (text.empty() || event.text == text)) return &event;
  return nullptr;
}

std::string FlightLog::story() const {
  std::string all;
  for (const Event& e : events)
    all += std::to_string(e.time.seconds()) + " s, " + std::to_string(e.entity.value) +
           ": " + std::string(e.kind.name()) + ": " + e.text + "\n";
  return all;
}

FlightLog fly(const std::string& text, const Flown& how) {
  const auto read =
      scenario::read_scenario_text(text, "flight", SKEIN_SOURCE_DIR, kind_table());
  if (!read.ok()) throw std::runtime_error(read.report());
  auto built = build(*read.scenario, KindRegistry());
  if (!built) throw std::runtime_error(built.error().text());
  if (!how.script.empty())
    for (simulation::Entity& entity : built.value().world.entities)
      if (entity.vehicle) entity.agent = std::make_unique<ScriptedAgent>(how.script);
  built.value().options.threads = how.threads;
  FlightLog log;
  simulation::Run run(built.value().world, built.value().options, log);
  while (!run.over())
    if (auto done = how.ticks > 0 ? run.step(how.ticks) : run.run_to_end(); !done)
      throw std::runtime_error(done.error().text());
  return log;
}

}  // namespace skein::assemble
