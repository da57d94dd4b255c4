// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/control_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace skein::mixed {
namespace {

constexpr std::uint8_t kWarning = 4;  // MAV_SEVERITY: what weighs as much, or more
// So long before a change of mode a text may be about it.
const Time kTextWindow = Time::from_seconds(15);

constexpr std::uint32_t bit(VehicleMode mode) {
  return std::uint32_t{1} << static_cast<unsigned>(mode);
}

// The modes that a request may lead to.
struct ModesOf {
  bool hovers;
  std::uint32_t operator()(const ModeRequest& r) const { return bit(r.mode); }
  std::uint32_t operator()(const TakeOffRequest&) const {
    return bit(VehicleMode::kTakeOff);
  }
  std::uint32_t operator()(const LandRequest&) const {
    return bit(VehicleMode::kLand) | (hovers ? 0U : bit(VehicleMode::kMission));
  }
  std::uint32_t operator()(const MissionStart&) const {
    return bit(VehicleMode::kMission);
  }
  template <class Other>
  std::uint32_t operator()(const Other&) const {
    return 0;
  }
};

bool is_by_sticks(VehicleMode mode) {
  return mode == VehicleMode::kManual || mode == VehicleMode::kStabilized;
}

bool goes_home_or_down(VehicleMode mode) {
  return mode == VehicleMode::kReturn || mode == VehicleMode::kLand;
}

// Words of autopilots' texts that say what went wrong; the first that fits counts.
FailsafeTrigger trigger_in(const std::string& text) {
  struct Word {
    std::string_view word;
    FailsafeTrigger trigger;
  };
  constexpr Word kWords[] = {
      {"batt", FailsafeTrigger::kBattery},     {"fence", FailsafeTrigger::kGeofence},
      {"gps", FailsafeTrigger::kGnss},         {"gnss", FailsafeTrigger::kGnss},
      {"ekf", FailsafeTrigger::kGnss},         {"position", FailsafeTrigger::kGnss},
      {"dead reckon", FailsafeTrigger::kGnss}, {"deadreckon", FailsafeTrigger::kGnss},
      {"motor", FailsafeTrigger::kMotor},      {"thrust", FailsafeTrigger::kMotor},
      {"esc ", FailsafeTrigger::kMotor},       {"imu", FailsafeTrigger::kImu},
      {"gyro", FailsafeTrigger::kImu},         {"gcs", FailsafeTrigger::kLink},
      {"link", FailsafeTrigger::kLink},        {"radio", FailsafeTrigger::kLink},
      {"rc ", FailsafeTrigger::kLink},         {"throttle", FailsafeTrigger::kLink},
      {"long event", FailsafeTrigger::kLink},  {"short event", FailsafeTrigger::kLink},
  };
  std::string lower = text;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  for (const Word& each : kWords)
    if (lower.find(each.word) != std::string::npos) return each.trigger;
  return FailsafeTrigger::kUnknown;
}

// What else is known of a vehicle that does not say why, for people.
std::string facts_of(const VehicleCondition& condition) {
  std::string text = "it gave no reason";
  if (condition.emergency) text += ", says that its state is critical";
  if (condition.voltage > 0) text += fmt::format(", has {:.1f} V", condition.voltage);
  return fmt::format("{}, charge {:.0f} %", text, 100 * condition.charge);
}

}  // namespace

void ControlMonitor::sent(const VehicleRequest& request) {
  newest_ = std::visit(ModesOf{hovers_}, request);
  asked_ |= newest_;
}

void ControlMonitor::denied() {
  if (seen_ && (newest_ & bit(mode_)) != 0) return;  // it is in it
  asked_ &= ~newest_;
}

void ControlMonitor::hear(const LinkChange& change) {
  if (change.kind == LinkChange::Kind::kUp) unseen_ = true;
  if (change.kind != LinkChange::Kind::kRebooted) return;
  unseen_ = true;
  withdrawn_ = false;
  asked_ = 0;
}

void ControlMonitor::hear(const VehicleText& text, Time now) {
  if (text.severity > kWarning || text.text.empty()) return;
  complaint_ = text.text;
  complained_ = now;
}

bool ControlMonitor::is_asked_for(VehicleMode mode) const {
  if (mode == VehicleMode::kGuided || (asked_ & bit(mode)) != 0) return true;
  // A take-off ends in holding where it ended, with some makes.
  return mode == VehicleMode::kHold && mode_ == VehicleMode::kTakeOff;
}

// Whether somebody else has it, who had not at the last step.
bool ControlMonitor::is_taken_now(const VehicleCondition& condition, bool changed,
                                  bool unseen) const {
  const VehicleMode mode = condition.mode;
  // On the ground it is nobody's, but where a flight has ended that nobody here ended, or
  // somebody else decides while it is to take off.
  const bool takes_off_next = (asked_ & bit(VehicleMode::kTakeOff)) != 0;
  if (condition.on_ground)
    return (flew_ || takes_off_next) && (changed || unseen) && !is_asked_for(mode);
  if (is_by_sticks(mode)) return true;
  if (!seen_) return goes_home_or_down(mode);  // in the air when it was heard first
  const bool takes_off = !in_air_;
  return (changed || takes_off) && !is_asked_for(mode);
}

void ControlMonitor::take(Time now, const VehicleCondition& condition, bool unseen,
                          std::vector<VehicleEvent>& events) {
  const Holder before = holder_;
  holder_ = is_by_sticks(condition.mode)                               ? Holder::kPilot
            : condition.emergency || goes_home_or_down(condition.mode) ? Holder::kFailsafe
                                                                       : Holder::kOther;
  const bool says_why =
      !complaint_.empty() && now - complained_ <= kTextWindow && !is_by_sticks(mode_);
  trigger_ = holder_ != Holder::kFailsafe ? FailsafeTrigger::kNone
             : says_why                   ? trigger_in(complaint_)
                                          : FailsafeTrigger::kUnknown;
  why_ = fmt::format("it {} in {}{}", condition.on_ground ? "stands" : "flies",
                     condition.mode_name, unseen ? " since its link was down" : " now");
  if (holder_ == Holder::kPilot) {
    if (before != holder_) events.push_back({EventKind::kPilotTookOver, why_});
    return;
  }
  why_ += holder_ == Holder::kFailsafe
              ? ", which its agent did not ask for"
              : ", which its agent did not ask for but a pilot or another station";
  if (holder_ == Holder::kFailsafe)
    why_ += says_why ? fmt::format(" (\"{}\")", complaint_)
                     : fmt::format(" ({})", facts_of(condition));
  why_ += "; it is left alone until its mode is guided or it is handed back";
  if (holder_ == Holder::kOther && before != holder_)
    events.push_back({EventKind::kModeChanged, why_});
}

void ControlMonitor::give_back() {
  holder_ = Holder::kAgent;
  trigger_ = FailsafeTrigger::kNone;
  why_.clear();
  asked_ = newest_ = 0;
  flew_ = in_air_;
}

bool ControlMonitor::step(Time now, const VehicleCondition& condition, bool lands,
                          std::vector<VehicleEvent>& events) {
  const bool changed = condition.mode_name != mode_name_;
  const bool unseen = std::exchange(unseen_, false);
  const bool claimed = std::exchange(withdrawn_, false) && !is_asked_for(condition.mode);
  bool given_back = false;
  if (is_taken()) {
    if (condition.mode == VehicleMode::kGuided) {
      give_back();
      given_back = true;
      events.push_back(
          {EventKind::kHandedBack, fmt::format("its mode is {}", condition.mode_name)});
    } else if (changed) {
      take(now, condition, unseen, events);
    }
  } else if (claimed || is_taken_now(condition, changed, unseen)) {
    take(now, condition, unseen && seen_, events);
  }
  seen_ = true;
  in_air_ = !condition.on_ground;
  mode_ = condition.mode;
  if (changed) mode_name_ = condition.mode_name;
  if ((newest_ & bit(mode_)) != 0) asked_ = newest_;  // what came before is over
  if (is_taken()) return given_back;
  if (in_air_) flew_ = true;
  if (!in_air_ && lands) flew_ = false;
  return given_back;
}

Result<void> ControlMonitor::hand_back() {
  if (!is_taken())
    return Error{ErrorCode::kBadInput, "", "it is commanded by its agent.",
                 "Only what was taken from its agent can be handed back."};
  if (holder_ == Holder::kPilot)
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("a pilot has it: it is in {}.", mode_name_),
                 "The pilot hands it back by choosing the guided mode."};
  give_back();
  flew_ = false;  // where it stands, it may take off again
  return {};
}

FailsafeTrigger ControlMonitor::trigger() const {
  return trigger_;
}

FailsafeReaction ControlMonitor::reaction() const {
  if (!is_taken() || holder_ == Holder::kPilot) return FailsafeReaction::kNone;
  switch (mode_) {
    case VehicleMode::kReturn:
      return FailsafeReaction::kReturn;
    case VehicleMode::kLand:
      return FailsafeReaction::kDescend;
    default:
      return FailsafeReaction::kHold;
  }
}

}  // namespace skein::mixed
