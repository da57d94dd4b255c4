#include "skein/assemble/run.h"

#include <utility>
#include <vector>

#include "skein/assemble/build.h"
#include "skein/record/fan_out.h"
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
  std::vector<Recorder*> listeners = {&recorder};
  if (how.listener) listeners.push_back(how.listener);
  record::FanOut all(std::move(listeners));
  const auto outcome = simulation::run(ready.world, ready.options, all, console);
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
