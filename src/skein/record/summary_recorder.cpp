#include "skein/record/summary_recorder.h"

#include <utility>

namespace skein::record {

SummaryRecorder::SummaryRecorder(RunInfo info) : info_(std::move(info)) {}

void SummaryRecorder::entity(EntityId id, const std::string& name,
                             const std::string& kind) {
  hash_.entity(id, name, kind);
  statistics_.entity(id, name, kind);
}

void SummaryRecorder::truth(Time time, EntityId id, const VehicleState& state) {
  hash_.truth(time, id, state);
  statistics_.truth(time, id, state.p_N, state.energy.charge);
}

void SummaryRecorder::estimate(EntityId id, const NavEstimate& estimate,
                               const AutopilotStatus& status) {
  hash_.estimate(id, estimate, status);
  statistics_.estimate(estimate.time, id, estimate.p_N,
                       status.follows ? std::optional(status.cross_track) : std::nullopt);
  statistics_.reserve(id, status.reserve);
}

void SummaryRecorder::reading(const FireReading& reading) {
  hash_.reading(reading);
  statistics_.reading();
}

void SummaryRecorder::message(const Message& message, Time arrived, bool lost) {
  hash_.message(message, arrived, lost);
  statistics_.message(lost);
}

void SummaryRecorder::perimeter(Time time, const geo::Region& truth, EntityId believer,
                                const BoundaryEstimate& belief) {
  hash_.perimeter(time, truth, believer, belief);
  statistics_.perimeter(time, TrueBoundary(truth), believer, belief);
}

void SummaryRecorder::event(const Event& event) {
  hash_.event(event);
  statistics_.event(event);
}

void SummaryRecorder::crossing(const Crossing& crossing) {
  hash_.crossing(crossing);
  statistics_.crossing(crossing);
}

void SummaryRecorder::zone(Time time, const ZoneChange& change) {
  hash_.zone(time, change);
}

void SummaryRecorder::object(const GroundObject& object) {
  hash_.object(object);
  statistics_.payload().object(object);
}

void SummaryRecorder::detection(const Detection& detection) {
  hash_.detection(detection);
  statistics_.payload().detection(detection);
}

void SummaryRecorder::footprint(const Footprint& footprint) {
  hash_.footprint(footprint);
  statistics_.payload().footprint();
}

void SummaryRecorder::ranges(const RangeScan& scan) {
  hash_.ranges(scan);
  statistics_.payload().ranges();
}

Result<void> SummaryRecorder::step_done(Time time) {
  now_ = time;
  return {};
}

RunSummary SummaryRecorder::summary(bool interrupted) const {
  return make_summary(info_, hash_, statistics_, extra_, now_,
                      std::chrono::steady_clock::now() - started_, interrupted);
}

RunSummary make_summary(const RunInfo& info, const ContentHash& hash,
                        const RunStatistics& statistics,
                        const std::map<std::string, double>& extra, Time simulated,
                        std::chrono::duration<double> wall, bool interrupted) {
  RunSummary summary;
  summary.version = info.version;
  summary.name = info.name;
  summary.seed = info.seed;
  summary.content_hash = hash.hex();
  summary.interrupted = interrupted;
  summary.numbers = statistics.figures();
  summary.numbers["simulated_s"] = simulated.seconds();
  summary.numbers["wall_s"] = wall.count();
  if (wall.count() > 0)
    summary.numbers["real_time_factor"] = simulated.seconds() / wall.count();
  summary.numbers["deadline_misses"] = 0;
  for (const auto& [name, value] : extra) summary.numbers[name] = value;
  return summary;
}

}  // namespace skein::record
