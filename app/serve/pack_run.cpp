// SPDX-License-Identifier: Apache-2.0
#include "app/serve/pack_run.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "app/serve/map_record.h"
#include "app/serve/record_thinner.h"
#include "app/serve/run_page.h"
#include "app/serve/terrain_bytes.h"
#include "skein/data/describe/wire.h"
#include "skein/layer/hmi/serve/live_state.h"
#include "skein/record/report/page.h"
#include "skein/record/store/record_stream.h"
#include "skein/scenario/scenario_file.h"

namespace skein::serve {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kShortestStep = 1;   // between frames [s]
constexpr double kMaxPlaces = 15000;  // of all aircraft in all frames
constexpr double kReadAhead = 60;     // of the run, at once [s]
constexpr double kMaxPieces = 2000;   // that a long run is read in
constexpr float kHeightStep = 0.25F;  // of the ground [m]
constexpr double kMargin = 1.1;       // around what is seen at first
constexpr double kMinExtent = 200;    // [m]

template <class T>
void put_raw(std::vector<std::byte>& out, T value) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof value);
}

// Where things happen.
class Extent {
 public:
  void add(const Vec2& p) {
    if (!p.allFinite()) return;
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  void add(const std::vector<Vec2>& points) {
    for (const Vec2& p : points) add(p);
  }
  void add(const BoundaryEstimate& boundary) {
    for (const auto& ring : boundary.rings)
      for (const BoundaryPoint& p : ring) add(p.position);
  }
  bool empty() const { return !(low_.x() <= high_.x()); }
  Vec2 centre() const { return 0.5 * (low_ + high_); }
  double size() const {
    return std::max(kMargin * (high_ - low_).maxCoeff(), kMinExtent);
  }

 private:
  Vec2 low_ = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high_ = -low_;
};

// What of a record belongs into the first view.
struct AddTo {
  void operator()(const PerimeterRecord& r) const {
    for (const geo::Ring& ring : r.truth) extent.add(ring);
    extent.add(r.belief);
  }
  void operator()(const Crossing& r) const { extent.add(r.point); }
  void operator()(const Detection& r) const { extent.add(r.point); }
  void operator()(const ObjectMotion& r) const { extent.add(r.position); }
  void operator()(const MissionRecord& r) const {
    if (const auto* survey = std::get_if<SurveyGoal>(&r.value.goal))
      extent.add(survey->area);
    if (const auto* patrol = std::get_if<PatrolGoal>(&r.value.goal))
      extent.add(patrol->line);
  }
  template <class Other>
  void operator()(const Other&) const {}

  Extent& extent;
};

class RunPacker {
 public:
  RunPacker(record::RecordStream& recorded, double share)
      : recorded_(recorded), share_(share), thinner_(share) {}

  Result<void> gather() {
    const record::RecordStream::Listener listener{
        [this](Time time, const Record& record) { take(time, record); },
        [](Time, const MetricSample&) {}};
    const Time end = recorded_.end();
    const Time piece =
        Time::from_seconds(std::max(kReadAhead, end.seconds() / kMaxPieces));
    for (Time until; until < end;) {
      until = std::min(until + piece, end);
      if (auto done = recorded_.advance(until, listener); !done) return done;
    }
    // A run without an end was cut off before its first second.
    if (auto done = recorded_.advance(end, listener); !done) return done;
    put_frames_before(end);
    put_frame(end);
    return {};
  }

  PackedRun finish() {
    PackedRun run;
    std::vector<LiveItem> items;
    Time time;
    const auto put = [&] {
      if (!items.empty()) put_message(time, items, run.records);
      items.clear();
    };
    for (RecordThinner::Kept& each : thinner_.finish()) {
      std::visit(AddTo{extent_}, each.record);
      if (each.time != time) put();
      time = each.time;
      items.emplace_back(LiveRecord{std::move(each.record)});
    }
    put();
    run.frames = std::move(frames_);
    run.step = std::max({step_.value_or(Time()), thinner_.spacing(TrafficBeliefRecord()),
                         thinner_.spacing(Footprint())})
                   .seconds();
    if (extent_.empty()) run.records.clear();
    return run;
  }

  const Extent& extent() const { return extent_; }

 private:
  void take(Time time, const Record& record) {
    put_frames_before(time);
    state_.take(record);
    if (const auto* entity = std::get_if<EntityRecord>(&record))
      aircraft_ += entity->kind == "aircraft";
    if (auto shown = for_map(record)) thinner_.take(time, *std::move(shown));
  }

  // Each frame has all that had happened by its time.
  void put_frames_before(Time time) {
    if (time <= Time()) return;
    // What there is comes before all else.
    if (!step_)
      step_ = Time::from_seconds(std::max(
          kShortestStep,
          std::ceil(recorded_.end().seconds() * aircraft_ / (share_ * kMaxPlaces))));
    for (; next_ < time; next_ += *step_) put_frame(next_);
  }

  void put_frame(Time time) {
    FleetFrame fleet = state_.fleet();
    TruthFrame truth = state_.truth();
    if (fleet.vehicles.empty() && truth.places.empty()) return;
    fleet.time = truth.time = time;
    for (const VehicleView& each : fleet.vehicles)
      extent_.add(Vec2(each.north, each.east));
    for (const TruePlace& each : truth.places) extent_.add(Vec2(each.north, each.east));
    put_message(time, {for_map(std::move(fleet)), for_map(std::move(truth))}, frames_);
  }

  void put_message(Time time, const std::vector<LiveItem>& items,
                   std::vector<std::byte>& out) {
    message_.clear();
    wire::encode(items, message_);
    put_raw(out, std::max(0.0, time.seconds()));
    put_raw(out, static_cast<std::uint32_t>(message_.size()));
    out.insert(out.end(), message_.begin(), message_.end());
  }

  record::RecordStream& recorded_;
  double share_;
  RecordThinner thinner_;
  hmi::LiveState state_;
  Extent extent_;
  double aircraft_ = 0;
  std::optional<Time> step_;  // between frames
  Time next_;                 // frame
  std::vector<std::byte> frames_, message_;
};

// As the page of the run would have it; without the origin where the scenario cannot be
// read.
std::string describe(const fs::path& directory, const record::RecordStream& recorded,
                     const assemble::TerrainPatch& terrain, const Extent& extent) {
  const record::RunInfo& info = recorded.info();
  const assemble::KindRegistry kinds;
  auto outcome = scenario::read_recorded_scenario_text(info.scenario_text, info.name,
                                                       directory, kinds.table());
  const bool is_readable = outcome.ok();
  const scenario::Scenario scenario =
      is_readable ? *std::move(outcome.scenario) : scenario::Scenario();
  Json run = Json::parse(facts_of(scenario, recorded, terrain).description);
  run["name"] = info.name;
  run["seed"] = info.seed;
  run["start_utc"] = info.start_utc;
  if (!is_readable) run["origin"] = nullptr;
  run["centre"] = {{"north_m", extent.centre().x()}, {"east_m", extent.centre().y()}};
  run["extent_m"] = extent.size();
  run["task_kinds"] = Json::array();  // nobody can give one
  return run.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// As browsers unpack it: RFC 1950.
std::string compressed(std::span<const std::byte> bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::byte> out(size);
  const int done = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(),
                             Z_BEST_COMPRESSION);
  SKEIN_CHECK(done == Z_OK, done);
  out.resize(size);
  return record::base64(out);
}

}  // namespace

Result<PackedRun> pack_run(const fs::path& directory, double share) {
  auto recorded = record::RecordStream::open(directory);
  if (!recorded) return recorded.error();
  RunPacker packer(recorded.value(), share);
  if (auto done = packer.gather(); !done) return done.error();
  PackedRun run = packer.finish();
  if (packer.extent().empty()) return run;
  assemble::TerrainPatch terrain = patch_of(recorded.value().terrain());
  for (float& height : terrain.heights)
    height = kHeightStep * std::round(height / kHeightStep);
  run.description = describe(directory, recorded.value(), terrain, packer.extent());
  if (terrain.rows > 0) run.terrain = terrain_bytes(terrain);
  return run;
}

Result<std::string> report_map(const fs::path& directory, double share) {
  auto run = pack_run(directory, share);
  if (!run) return run.error();
  if (run.value().description.empty()) return std::string();
  const auto bytes = [](const std::string& text) {
    return std::as_bytes(std::span(text));
  };
  const Json map = {{"run", Json::parse(run.value().description)},
                    {"step_s", run.value().step},
                    {"terrain", compressed(bytes(run.value().terrain))},
                    {"records", compressed(run.value().records)},
                    {"frames", compressed(run.value().frames)}};
  return map.dump();
}

}  // namespace skein::serve
