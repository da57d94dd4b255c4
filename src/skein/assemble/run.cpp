#include "skein/assemble/run.h"

#include <optional>

#include "skein/assemble/build.h"
#include "skein/record/summary_recorder.h"
#include "skein/simulation/run.h"

namespace skein::assemble {
namespace {

class QuietConsole : public OperatorConsole {
 public:
  explicit QuietConsole(const std::atomic<bool>* stop) : stop_(stop) {}
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return stop_ && *stop_; }

 private:
  const std::atomic<bool>* stop_;
};

// Two recorders as one.
class BothRecorders final : public Recorder {
 public:
  BothRecorders(Recorder& first, Recorder& second) : first_(first), second_(second) {}

  void entity(EntityId id, const std::string& name, const std::string& kind) override {
    first_.entity(id, name, kind);
    second_.entity(id, name, kind);
  }
  void truth(Time time, EntityId id, const VehicleState& state) override {
    first_.truth(time, id, state);
    second_.truth(time, id, state);
  }
  void estimate(EntityId id, const NavEstimate& estimate,
                const AutopilotStatus& status) override {
    first_.estimate(id, estimate, status);
    second_.estimate(id, estimate, status);
  }
  void reading(const FireReading& reading) override {
    first_.reading(reading);
    second_.reading(reading);
  }
  void message(const Message& message, Time arrived, bool lost) override {
    first_.message(message, arrived, lost);
    second_.message(message, arrived, lost);
  }
  void perimeter(Time time, const geo::Region& truth, EntityId believer,
                 const BoundaryEstimate& belief) override {
    first_.perimeter(time, truth, believer, belief);
    second_.perimeter(time, truth, believer, belief);
  }
  void event(const Event& event) override {
    first_.event(event);
    second_.event(event);
  }
  void crossing(const Crossing& crossing) override {
    first_.crossing(crossing);
    second_.crossing(crossing);
  }
  void zone(Time time, const ZoneChange& change) override {
    first_.zone(time, change);
    second_.zone(time, change);
  }
  void object(const GroundObject& object) override {
    first_.object(object);
    second_.object(object);
  }
  void detection(const Detection& detection) override {
    first_.detection(detection);
    second_.detection(detection);
  }
  void footprint(const Footprint& footprint) override {
    first_.footprint(footprint);
    second_.footprint(footprint);
  }
  void ranges(const RangeScan& scan) override {
    first_.ranges(scan);
    second_.ranges(scan);
  }
  Result<void> step_done(Time time) override {
    auto done = first_.step_done(time);
    if (!done) return done;
    return second_.step_done(time);
  }

 private:
  Recorder& first_;
  Recorder& second_;
};

}  // namespace

Result<record::RunSummary> run_quietly(const scenario::Scenario& scenario,
                                       const KindRegistry& kinds, const QuietRun& how) {
  auto built = build(scenario, kinds);
  if (!built) return built.error();
  Build& ready = built.value();
  ready.options.speed = how.speed;
  ready.options.threads = how.threads;
  record::SummaryRecorder recorder(
      {how.version, scenario.seed, scenario.name, how.text, scenario.start_utc});
  QuietConsole console(how.stop);
  std::optional<BothRecorders> both;
  if (how.listener) both.emplace(recorder, *how.listener);
  Recorder& told = both ? static_cast<Recorder&>(*both) : recorder;
  const auto outcome = simulation::run(ready.world, ready.options, told, console);
  if (!outcome) return outcome.error();
  if (outcome.value().end == simulation::RunOutcome::End::kStopped)
    return Error{ErrorCode::kInterrupted, scenario.name, "stopped before its end.", ""};
  recorder.set_figure("deadline_misses",
                      static_cast<double>(outcome.value().deadline_misses));
  record::RunSummary summary = recorder.summary();
  summary.warnings = ready.warnings;
  return summary;
}

}  // namespace skein::assemble
