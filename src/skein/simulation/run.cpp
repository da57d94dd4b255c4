// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <utility>

#include "skein/role/vehicle.h"
#include "skein/simulation/run_view.h"
#include "skein/simulation/stepper.h"

namespace skein::simulation {
namespace {

// What ended the run at `now`, and when that was.
Error failed_at(Time now, Error error) {
  while (!error.message.empty() && error.message.back() == '.') error.message.pop_back();
  error.message += fmt::format(" (at {:.3f} s of simulated time).", now.seconds());
  return error;
}

const Vehicle* vehicle_of(const World& world, EntityId id) {
  return id.value < world.entities.size() ? world.entities[id.value].vehicle.get()
                                          : nullptr;
}

}  // namespace

Run::Run(World& world, RunOptions options, Recorder& recorder)
    : world_(world),
      options_(std::move(options)),
      view_(options_.keeps_view ? std::make_unique<RunView>(recorder) : nullptr),
      stepper_(std::make_unique<Stepper>(
          world_, options_, view_ ? static_cast<Recorder&>(*view_) : recorder)) {
  stepper_->introduce();
  over_ = options_.duration < Time();
}

Run::~Run() = default;

// Whatever an action throws ends the run, not the program: others may be going on.
template <class Action>
Result<void> Run::guarded(Action action) {
  Result<void> done;
  try {
    done = action();
  } catch (const std::bad_alloc&) {
    done = Error{ErrorCode::kUnavailable, "", "not enough memory",
                 "Use a coarser grid or fewer members, or run fewer at a time."};
  } catch (const std::exception& fault) {
    done = internal_error(fault.what());
  }
  if (done) return done;
  over_ = true;
  failure_ = failed_at(now_, done.error());
  return *failure_;
}

Result<void> Run::check_going() const {
  if (failure_) return *failure_;
  if (!over_) return {};
  return Error{ErrorCode::kBadInput, "",
               fmt::format("the run is over: it ended at {:.3f} s of simulated time.",
                           simulated().seconds()),
               "Open it again to have it once more."};
}

Time Run::simulated() const {
  return std::max(Time(), std::min(now_, options_.duration));
}

void Run::take_due() {
  while (next_command_ < options_.commands.size() &&
         options_.commands[next_command_].time <= now_) {
    const CommandRecord& due = options_.commands[next_command_++];
    // What cannot be obeyed is an event.
    static_cast<void>(stepper_->command(now_, due.sender, due.command));
  }
}

Result<void> Run::tick() {
  take_due();
  if (auto stepped = stepper_->step(now_); !stepped) return stepped;
  now_ += options_.step;
  if (now_ <= options_.duration) return {};
  over_ = true;
  stepper_->finish();
  return {};
}

Result<void> Run::step(std::int64_t ticks) {
  if (auto going = check_going(); !going) return going;
  if (ticks < 0)
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("{} steps cannot be made: time goes on only.", ticks), ""};
  announcements_.clear();
  Result<void> done;
  for (; ticks > 0 && !over_; --ticks) done = guarded([this] { return tick(); });
  announcements_ = stepper_->take_announcements();
  return done;
}

Result<void> Run::run_until(Time time) {
  if (auto going = check_going(); !going) return going;
  if (time < now_)
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("{:.3f} s are past: the run has come to {:.3f} s.",
                             time.seconds(), now_.seconds()),
                 ""};
  const Time left = std::min(time, options_.duration + Time::from_ns(1)) - now_;
  return step((left.ns() + options_.step.ns() - 1) / options_.step.ns());
}

Result<void> Run::run_to_end() {
  return completed() ? Result<void>() : run_until(options_.duration + options_.step);
}

Result<void> Run::command(std::string sender, const Command& command) {
  if (auto going = check_going(); !going) return going;
  Result<void> obeyed;
  auto done = guarded([&]() -> Result<void> {
    take_due();
    obeyed = stepper_->command(now_, std::move(sender), command);
    return {};
  });
  return done ? obeyed : done;
}

Result<std::span<const CommandRecord>> Run::obey_due() {
  if (auto going = check_going(); !going) return going.error();
  const std::size_t first = next_command_;
  auto done = guarded([this]() -> Result<void> {
    take_due();
    return {};
  });
  if (!done) return done.error();
  return std::span(options_.commands).subspan(first, next_command_ - first);
}

Result<void> Run::finish() {
  if (failure_) return *failure_;
  if (std::exchange(over_, true)) return {};
  return guarded([this]() -> Result<void> {
    stepper_->finish();
    return {};
  });
}

Result<EntityId> Run::find(std::string_view name) const {
  constexpr std::size_t kMaxNames = 20;
  std::string all;
  for (std::size_t i = 0; i < world_.entities.size(); ++i) {
    if (world_.entities[i].name == name) return EntityId{static_cast<std::uint32_t>(i)};
    if (i < kMaxNames) all += (all.empty() ? "" : ", ") + world_.entities[i].name;
  }
  if (world_.entities.size() > kMaxNames) all += "...";
  return Error{ErrorCode::kBadInput, std::string(name),
               fmt::format("is no aircraft or station of the run; it has: {}.", all), ""};
}

std::string_view Run::name_of_entity(EntityId id) const {
  return stepper_->name_of_entity(id);
}

std::optional<VehicleState> Run::truth(EntityId aircraft) const {
  const Vehicle* vehicle = vehicle_of(world_, aircraft);
  const VehicleState* state = vehicle ? vehicle->truth() : nullptr;
  return state ? std::optional(*state) : std::nullopt;
}

std::optional<NavEstimate> Run::estimate(EntityId aircraft) const {
  const Vehicle* vehicle = vehicle_of(world_, aircraft);
  if (!vehicle || !stepper_->has_begun(aircraft)) return std::nullopt;
  return vehicle->estimate();
}

std::optional<AutopilotStatus> Run::status(EntityId aircraft) const {
  const Vehicle* vehicle = vehicle_of(world_, aircraft);
  if (!vehicle || !stepper_->has_begun(aircraft)) return std::nullopt;
  return vehicle->status();
}

std::vector<Event> Run::take_events() {
  return view_ ? view_->take_events() : std::vector<Event>();
}

std::vector<PerimeterRecord> Run::perimeter_beliefs(EntityId station) const {
  return view_ ? view_->perimeters(station) : std::vector<PerimeterRecord>();
}

std::vector<ObjectBeliefRecord> Run::object_beliefs(EntityId station) const {
  return view_ ? view_->objects(station) : std::vector<ObjectBeliefRecord>();
}

std::vector<TrafficBeliefRecord> Run::traffic_beliefs(EntityId aircraft) const {
  return view_ ? view_->traffic(aircraft) : std::vector<TrafficBeliefRecord>();
}

std::string Run::headline() const {
  return stepper_->headline();
}

}  // namespace skein::simulation
