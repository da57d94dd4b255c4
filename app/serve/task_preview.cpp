// SPDX-License-Identifier: Apache-2.0
#include "app/serve/task_preview.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/build.h"
#include "skein/data/describe/json.h"
#include "skein/data/describe/walk.h"
#include "skein/role/operator_console.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/utc.h"
#include "skein/simulation/run.h"

namespace skein::serve {
namespace {

constexpr double kLookAhead = 1800;        // [s]
constexpr double kRate = 1;                // of points of the path [1/s]
constexpr std::size_t kMaxPoints = 400;    // that are answered
constexpr std::size_t kMaxQuestions = 16;  // that wait

const scenario::AircraftGroup* group_of(const scenario::Scenario& scenario,
                                        const std::string& aircraft) {
  const auto names = assemble::aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g)
    if (std::find(names[g].begin(), names[g].end(), aircraft) != names[g].end())
      return &scenario.aircraft[g];
  return nullptr;
}

// What cannot be foreseen; empty: nothing.
std::string unforeseen(const TaskKind& what) {
  if (needs_of(what).foreseen) return {};
  return others_of(what).empty() ? "where it leads will be sensed."
                                 : "where it leads depends on others.";
}

// With its times counted from now on.
TaskKind from_now(TaskKind what, Time now) {
  walk::shift_times(what, Time() - now);
  return what;
}

std::string text_of(const Command& command) {
  return json::line_of(json::to_json(command));
}

// The aircraft alone, from now on.
scenario::Scenario alone(const scenario::Scenario& scenario,
                         const scenario::AircraftGroup& group,
                         const scenario::KindTable& kinds,
                         const hmi::PreviewOrder& order) {
  scenario::Scenario own = scenario;
  const VehicleView& now = order.now;
  scenario::AircraftGroup one = group;
  one.count = 1;
  one.vehicle = scenario::default_choice(kinds, "vehicle", "simulated");
  one.physical.reset();
  one.observes.reset();
  one.station.clear();
  one.join = Time();
  one.leave.reset();
  one.comeback.reset();
  one.failures.clear();
  one.random_failures.clear();
  one.start = {};
  one.start.placement = scenario::Placement::kList;
  one.start.positions = {Vec2(now.north, now.east)};
  one.start.altitude_msl = now.altitude_msl;
  one.start.on_ground = now.on_ground;
  one.start.heading = geo::radians(now.heading_deg);
  own.aircraft = {std::move(one)};
  own.traffic.clear();
  own.missions.clear();
  own.links = {};
  own.radio = scenario::default_choice(kinds, "radio", "ideal");
  scenario::Station station;
  station.position = scenario.stations.front().position;
  own.stations = {std::move(station)};
  own.environment.turbulence = scenario::default_choice(kinds, "turbulence", "none");
  own.environment.gusts.clear();
  own.environment.phenomena.clear();
  own.environment.zone_rings.clear();
  own.environment.zones.clear();
  own.environment.memory = {};
  if (const auto start = scenario::parse_utc(scenario.start_utc))
    own.start_utc =
        scenario::utc_text(*start + static_cast<std::int64_t>(order.time.seconds()));
  own.duration = Time::from_seconds(kLookAhead);
  own.record.rate_hz = kRate;
  own.record.messages = false;
  own.commands.clear();
  if (order.wind) own.commands.push_back({Time(), text_of(*order.wind)});
  for (Zone zone : order.zones) {
    // Times count from now on.
    zone.from -= order.time.seconds();
    zone.until -= order.time.seconds();
    own.commands.push_back({Time(), text_of(ZoneChange{0, true, std::move(zone)})});
  }
  const std::string name = assemble::aircraft_names(own).front().front();
  if (order.flight)
    own.commands.push_back(
        {Time(), text_of(FlightChangeCommand{name, order.flight->altitude_agl,
                                             order.flight->airspeed})});
  TaskCommand task;
  task.aircraft = name;
  task.what = from_now(order.what, order.time);
  own.commands.push_back({Time(), text_of(task)});
  return own;
}

// Takes down how the task goes; the end of it is the end of the run.
class PreviewRecorder final : public Recorder {
 public:
  void record(const Record& record) override {
    if (const auto* estimate = std::get_if<EstimateRecord>(&record))
      take(*estimate);
    else if (const auto* event = std::get_if<Event>(&record))
      take(*event);
  }
  Result<void> step_done(Time time) override {
    if (!ended_) now_ = time;
    return {};
  }
  bool ended() const { return ended_; }

  TaskPreview answer() && {
    preview_.duration = now_.seconds();
    while (preview_.path.points.size() > kMaxPoints) thin();
    preview_.path.ends = preview_.done;
    return std::move(preview_);
  }

 private:
  void take(const EstimateRecord& estimate) {
    const Vec3& p = estimate.nav.p_N;
    const PathPoint here{static_cast<float>(estimate.nav.time.seconds()),
                         static_cast<float>(p.x()), static_cast<float>(p.y()),
                         static_cast<float>(-p.z())};
    auto& points = preview_.path.points;
    if (!points.empty())
      preview_.length +=
          Vec2(here.north - points.back().north, here.east - points.back().east).norm();
    else
      first_charge_ = estimate.status.charge;
    points.push_back(here);
    preview_.charge = first_charge_ - estimate.status.charge;
  }

  void take(const Event& event) {
    if (event.kind == EventKind::kTaskDone) {
      preview_.done = true;
    } else if (event.kind == EventKind::kTaskRefused ||
               event.kind == EventKind::kTaskImpossible ||
               event.kind == EventKind::kAccident ||
               event.kind == EventKind::kCommandRefused ||
               event.kind == EventKind::kNoPath) {
      preview_.problem = event.text.empty() ? std::string(event.kind.name()) : event.text;
    } else {
      return;
    }
    ended_ = true;
    now_ = event.time;
  }

  // Every second point goes, but the last stays.
  void thin() {
    auto& points = preview_.path.points;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k % 2 == 0 || k + 1 == points.size()) points[kept++] = points[k];
    points.resize(kept);
  }

  TaskPreview preview_;
  double first_charge_ = 1;
  Time now_;
  bool ended_ = false;
};

TaskPreview impossible(std::string why) {
  TaskPreview preview;
  preview.problem = std::move(why);
  return preview;
}

}  // namespace

TaskPreview preview_task(const scenario::Scenario& scenario,
                         const assemble::KindRegistry& kinds,
                         const hmi::PreviewOrder& order, const std::atomic<bool>& stop) {
  const scenario::AircraftGroup* group = group_of(scenario, order.aircraft);
  if (!group)
    return impossible(fmt::format("there is no aircraft \"{}\".", order.aircraft));
  if (std::string why = unforeseen(order.what); !why.empty())
    return impossible(std::move(why));
  auto built = assemble::build(alone(scenario, *group, kinds.table(), order), kinds);
  if (!built) return impossible(built.error().text());
  assemble::Build& ready = built.value();
  ready.options.threads = 1;
  PreviewRecorder recorder;
  simulation::Run run(ready.world, ready.options, recorder);
  while (!run.over() && !recorder.ended() && !stop)
    if (auto stepped = run.step(); !stepped) return impossible(stepped.error().text());
  TaskPreview preview = std::move(recorder).answer();
  preview.charge_left = std::max(0.0, order.now.charge - preview.charge);
  return preview;
}

TaskPreviewer::TaskPreviewer(scenario::Scenario scenario,
                             const assemble::KindRegistry& kinds, Answer answer)
    : scenario_(std::move(scenario)),
      kinds_(kinds),
      answer_(std::move(answer)),
      thread_([this] { work(); }) {}

TaskPreviewer::~TaskPreviewer() {
  {
    const std::lock_guard guard(lock_);
    ended_ = true;
    stop_ = true;
  }
  asked_.notify_one();
  thread_.join();
}

void TaskPreviewer::ask(hmi::ClientNumber client, std::uint32_t number,
                        hmi::PreviewOrder order) {
  const std::lock_guard guard(lock_);
  std::erase_if(questions_,
                [client](const Question& each) { return each.client == client; });
  if (answered_client_ == client) stop_ = true;
  if (questions_.size() >= kMaxQuestions) questions_.pop_front();
  questions_.push_back({client, number, std::move(order)});
  asked_.notify_one();
}

void TaskPreviewer::work() {
  for (;;) {
    Question question;
    {
      std::unique_lock guard(lock_);
      answered_client_ = 0;
      asked_.wait(guard, [this] { return ended_ || !questions_.empty(); });
      if (ended_) return;
      question = std::move(questions_.front());
      questions_.pop_front();
      answered_client_ = question.client;
      stop_ = false;
    }
    TaskPreview preview = preview_task(scenario_, kinds_, question.order, stop_);
    preview.number = question.number;
    if (!stop_) answer_(question.client, preview);
  }
}

}  // namespace skein::serve
