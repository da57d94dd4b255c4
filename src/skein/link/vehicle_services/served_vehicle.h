// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/vehicle/vehicle_report.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/vehicle_services/expected.h"
#include "skein/link/vehicle_services/mode_table.h"
#include "skein/link/vehicle_services/request_queue.h"
#include "skein/link/vehicle_services/vehicle_snapshot.h"

namespace skein::vehicle_services {

/// What ground stations have set by parameters.
struct VehicleSettings {
  double loiter_radius = 0;  ///< [m]
  bool clockwise = true;
  double take_off_height = 0;  ///< above home [m]
  bool arming_checks = true;
};

/// The mission as the simulation has it, and where it is in it.
struct StoredMission {
  std::vector<MissionItem> items;
  std::uint16_t first = 0;  ///< number that ground stations give to the first item
  /// Item to begin with when the mission is flown next.
  std::optional<std::uint16_t> selected;
  Expected<std::uint16_t> expected;  ///< an item that it was sent to
  bool started = false;              ///< some of it was flown
};

/// What guided flight was sent last.
struct GuidedState {
  std::optional<FlyToRequest> place;
  std::optional<double> altitude_msl;  ///< [m]
  double climb_rate = 0;               ///< on the way there [m/s]; 0: its own
  std::optional<double> airspeed;      ///< [m/s]
  std::optional<double> heading;       ///< to be kept [rad]
  bool over_ground = false;            ///< that is a course
  Time next_heading;                   ///< when it is due again, of the run
  std::optional<Time> last_setpoint;   ///< of a stream, by the wall clock
  std::optional<Time> last_bank;       ///< the same of an attitude
};

/// What the channels of a transmitter carry over the link.
struct Sticks {
  static constexpr std::size_t kCount = 18;
  bool active = false;
  std::array<std::uint16_t, kCount> pwm_us{};  ///< 0: nothing
};

/// What the parts of a VehicleServer share: the vehicle as it was last seen, what was
/// asked of it, and what is to be said.
struct ServedVehicle {
  ServedVehicle(const VehicleServerOptions& options, const geo::LocalFrame& frame);

  /// The simulation has moved on.
  void update(const VehicleSnapshot& next);

  /// With what was asked for and does not show yet.
  bool armed() const { return armed_expected.value_or(snapshot.condition.armed); }
  VehicleMode mode() const { return mode_expected.value_or(snapshot.condition.mode); }
  bool flying() const { return known && !snapshot.condition.on_ground; }

  /// The mode as ground stations are shown it.
  const ModeRow& shown_mode() const;

  double altitude_msl() const { return -snapshot.motion.p_N.z(); }
  double home_msl() const { return -snapshot.home_N.z(); }
  /// The axes of LOCAL_POSITION_NED begin where home was at the beginning.
  Vec3 from_origin(const Vec3& p_N) const { return p_N - origin_N; }
  /// Flown when nothing else was asked for [m/s].
  double airspeed() const { return guided.airspeed.value_or(options.limits.airspeed); }
  /// Item of the mission that counts as the present one.
  std::uint16_t present_item() const;

  /// @returns  false when the simulation has not taken what was asked for before.
  bool request(VehicleRequest request) { return requests.add(std::move(request)); }
  /// The same for what puts it into a mode, which ground stations are shown as this row
  /// of the table.
  bool request_mode(VehicleRequest request, const ModeRow& row);
  /// What guided flight was sent no longer counts, but for the airspeed.
  void forget_guided();

  /// Says something at all ground stations.
  void say(mavlink::Severity severity, std::string text);

  const VehicleServerOptions options;
  const geo::LocalFrame frame;
  Clocks now;
  bool known = false;  ///< a snapshot came
  VehicleSnapshot snapshot;
  Vec3 origin_N = Vec3::Zero();

  VehicleSettings settings;
  StoredMission mission;
  GuidedState guided;
  Sticks sticks;
  Fence fence;
  std::optional<Vec3> home_setpoint;
  /// To be sent when it is armed, while its mode is the take-off, or for half a minute.
  std::optional<TakeOffRequest> take_off_when_armed;
  Time take_off_waits_until;

  Expected<bool> armed_expected;
  Expected<VehicleMode> mode_expected;
  RequestQueue requests;
  std::vector<VehicleText> texts;
  std::vector<std::uint16_t> reached;  ///< items, not announced yet

 private:
  // What is looked back at after an update.
  struct Before {
    VehicleMode mode;
    MissionProgress progress;
    bool jumped;  // it was sent to another item
  };
  void follow_mission(const Before& before);
  void follow_take_off();

  // How its mode was asked for.
  const ModeRow* asked_ = nullptr;
};

}  // namespace skein::vehicle_services
