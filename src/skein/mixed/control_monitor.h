// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/role/vehicle.h"

namespace skein::mixed {

/// Who flies a vehicle behind a link: its agent, or somebody else.
///
/// Its agent does while the vehicle is in a mode that was asked for here and not denied,
/// or in the guided mode. Any other mode that it goes into in the air is somebody's will:
/// of a pilot, of a failsafe of its own, of another station; whether that was seen or
/// happened while the link was down. So is a flight that ended otherwise than was asked
/// for. What a mode is called says nothing about who chose it: only what was sent and not
/// denied is known to be asked for here.
///
/// Whoever has taken it keeps it until its mode is guided again, or until hand_back().
class ControlMonitor {
 public:
  enum class Holder : std::uint8_t {
    kAgent,
    kPilot,     ///< by sticks
    kFailsafe,  ///< it says that its state is critical, or returns or lands by itself
    kOther,     ///< another mode, of a pilot's switch or another station
  };

  /// @param hovers  a multirotor, which lands in a mode of its own; else by a mission
  ///                too.
  explicit ControlMonitor(bool hovers) : hovers_(hovers) {}

  /// A request has gone out: the modes that it leads to are asked for.
  void sent(const VehicleRequest& request);
  /// The newest of them was denied.
  void denied();
  /// The newest of them was withdrawn, because somebody else chose the mode while it was
  /// under way: who did so has it, on the ground too.
  void withdrawn() { withdrawn_ = true; }
  void hear(const LinkChange& change);
  /// What the vehicle says before it acts is why it does.
  void hear(const VehicleText& text, Time now);

  /// Once a step of the run while its link is up.
  /// @param lands  its agent wants it on the ground.
  /// @returns      whether it has been given back.
  bool step(Time now, const VehicleCondition& condition, bool lands,
            std::vector<VehicleEvent>& events);

  /// Its agent has it again.
  /// Fails: kBadInput when it has it, or when sticks fly it.
  Result<void> hand_back();

  Holder holder() const { return holder_; }
  bool is_taken() const { return holder_ != Holder::kAgent; }
  /// The mode that it was last seen in.
  VehicleMode mode() const { return mode_; }
  /// Of a failsafe of its own; kNone without one.
  FailsafeTrigger trigger() const;
  /// What the mode does that somebody else has chosen; kNone while its agent or sticks
  /// fly it.
  FailsafeReaction reaction() const;
  /// Who has taken it and why, for people; empty while its agent has it.
  std::string_view why() const { return why_; }

 private:
  bool is_asked_for(VehicleMode mode) const;
  bool is_taken_now(const VehicleCondition& condition, bool changed, bool unseen) const;
  void take(Time now, const VehicleCondition& condition, bool unseen,
            std::vector<VehicleEvent>& events);
  void give_back();

  bool hovers_;
  Holder holder_ = Holder::kAgent;
  std::uint32_t asked_ = 0;   // modes, a bit each
  std::uint32_t newest_ = 0;  // of the newest request
  bool seen_ = false;         // some mode, since the begin
  bool in_air_ = false;       // at the last step
  bool flew_ = false;         // under its agent, and has not been landed by it
  bool withdrawn_ = false;    // a request, since the last step
  bool unseen_ = false;  // the link was down, or it has begun again, since the last step
  VehicleMode mode_ = VehicleMode::kOther;
  std::string mode_name_;
  std::string why_, complaint_;  // the last text of weight
  Time complained_;
  FailsafeTrigger trigger_ = FailsafeTrigger::kNone;
};

}  // namespace skein::mixed
