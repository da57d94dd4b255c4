// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/link/physics/answer_watch.h"
#include "skein/link/physics/ardupilot_backend.h"
#include "skein/link/physics/channel_map.h"
#include "skein/link/physics/driving_program.h"
#include "skein/role/autopilot_drive.h"

namespace skein::physics {

/// The run's time as a lock-step drive has it, for others of its vehicle [ns].
using DriveClock = std::shared_ptr<std::atomic<std::int64_t>>;

/// Where SITL believes that it begins; what it is told by --home.
struct SitlHome {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double alt_msl = 0;  ///< [m]
};

struct ArduPilotDriveOptions {
  std::string name;  ///< of the vehicle, for people
  std::uint16_t port = 9002;
  SitlHome home;
  Patience patience;
};

/// A place as SITL has it, from its home: it takes metres for angles by the length of a
/// degree of latitude on its sphere, and shrinks those to the east by the cosine of the
/// mean latitude. So the place that its receivers report is the one that is meant.
/// @param p_N  [m], of `frame`.
/// @returns    north, east, down [m].
Vec3 sitl_place(const Vec3& p_N, const geo::LocalFrame& frame, const SitlHome& home);

/// ArduPilot's SITL (model JSON) moves a plant, in lock-step.
class ArduPilotDrive final : public AutopilotDrive {
 public:
  /// @param clock  is given the run's time with each step.
  ArduPilotDrive(ArduPilotDriveOptions options, const geo::LocalFrame& frame,
                 ChannelMap channels, DrivingProgram program, DriveClock clock);
  /// Ends its program, in order if it does so within a moment.
  ~ArduPilotDrive() override;

  Result<void> open() override;
  void begin(Time now) override;
  void look_after(Time now) override;
  bool exchange(const SensedMotion& motion, std::span<float> channels) override;
  void take_events(Time now, std::vector<OutsideEvent>& out) override;

  /// Where it waits, with the port that it has got; 0 before open().
  std::uint16_t port() const { return backend_ ? backend_->port() : std::uint16_t{0}; }

  /// What the pulse widths of a frame are as outputs of a ChannelMap: 1000 to 2000 us are
  /// -1 to 1 of a surface, 0 to 1 of a motor; no pulse is 0.
  static std::vector<double> outputs_of(const ServoFrame& frame, const ChannelMap& map);

 private:
  std::optional<ServoFrame> wait(std::chrono::nanoseconds allowed);
  bool reply(const SensedMotion& motion);
  bool miss();

  ArduPilotDriveOptions options_;
  geo::LocalFrame frame_;
  ChannelMap channels_;
  DrivingProgram program_;
  DriveClock clock_;
  std::optional<ArduPilotBackend> backend_;  // none: not opened
  AnswerWatch watch_;
  std::uint64_t restarts_ = 0;  // that have been seen
  bool asked_ = false;          // a frame waits for its answer
  std::optional<Time> zero_;    // of SITL's clock; none: the next step begins it
  SensedMotion last_;
  std::vector<OutsideEvent> events_;
};

}  // namespace skein::physics
