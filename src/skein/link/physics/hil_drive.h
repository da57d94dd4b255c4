// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/random.h"
#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/link/physics/answer_watch.h"
#include "skein/link/physics/ardupilot_drive.h"
#include "skein/link/physics/channel_map.h"
#include "skein/link/physics/driving_program.h"
#include "skein/link/physics/hil_simulator.h"
#include "skein/role/autopilot_drive.h"

namespace skein::physics {

/// Makes what the sensors of an autopilot measure of a motion.
///
/// White noise on all of them: PX4 takes a sensor that always says the same for broken.
/// Standard deviations: 0.05 m/s^2, 0.001 rad/s, 2 mG, 1.5 Pa, 2 Pa of the pitot tube,
/// 0.3 m and 0.5 m of positions, 0.1 m/s.
class HilSensing {
 public:
  /// @param start_utc_us  calendar at the run's begin, in microseconds since 1970.
  HilSensing(const geo::LocalFrame& frame, const RandomStream& noise,
             std::int64_t start_utc_us, std::optional<double> declination)
      : frame_(frame),
        noise_(noise),
        start_utc_us_(start_utc_us),
        declination_(declination) {}

  HilSensors sensors(const SensedMotion& motion);
  HilFix fix(const SensedMotion& motion);
  HilTruth truth(const SensedMotion& motion) const;

 private:
  Vec3 noise3(double deviation);

  geo::LocalFrame frame_;
  FastNormals noise_;
  std::int64_t start_utc_us_;
  std::optional<double> declination_;
};

struct HilDriveOptions {
  std::string name;  ///< of the vehicle, for people
  HilOptions link;
  Patience patience;
};

/// PX4, or another autopilot that takes HIL messages, moves a plant: in lock-step, or by
/// the wall clock, for hardware; then each step is taken when its time has come.
class HilDrive final : public AutopilotDrive {
 public:
  /// @param clock  is given the run's time with each step.
  HilDrive(HilDriveOptions options, HilSensing sensing, ChannelMap channels,
           DrivingProgram program, DriveClock clock);
  ~HilDrive() override;

  Result<void> open() override;
  bool real_time() const override { return !options_.link.lock_step; }
  void begin(Time now) override;
  void look_after(Time now) override;
  bool exchange(const SensedMotion& motion, std::span<float> channels) override;
  void take_events(Time now, std::vector<OutsideEvent>& out) override;

  /// Where it waits, with the port that it has got; empty before open() and for a line.
  std::string place() const { return simulator_ ? simulator_->place() : std::string(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool wait_for_connection(std::chrono::nanoseconds allowed);
  void wait_for_wall(Time now);

  HilDriveOptions options_;
  HilSensing sensing_;
  ChannelMap channels_;
  DrivingProgram program_;
  DriveClock clock_;
  std::unique_ptr<HilSimulator> simulator_;  // null: not opened
  AnswerWatch watch_;
  Time begin_, fix_due_;
  std::optional<Clock::time_point> begin_wall_;  // that begin_ stands for
  Clock::time_point heard_;                      // controls, in real time
  std::vector<OutsideEvent> events_;
};

}  // namespace skein::physics
