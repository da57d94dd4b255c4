// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <array>

#include "skein/base/id.h"
#include "skein/base/outages.h"
#include "skein/base/random.h"
#include "skein/layer/sensory/gauss_markov.h"
#include "skein/layer/sensory/periodic_sensor.h"

namespace skein::sensory {

struct GnssReceiverOptions {
  double rate_hz = 5;    ///< fixes per second
  double latency = 0.1;  ///< [s]
  GnssKind kind = GnssKind::kSingle;
  // Standard deviations of the error of one range, by source, before correction [m]:
  double clock_sd = 2;          ///< satellite clock
  double orbit_sd = 2.5;        ///< satellite orbit
  double ionosphere_sd = 5;     ///< ionosphere
  double troposphere_sd = 0.5;  ///< troposphere
  double multipath_sd = 1;      ///< multipath
  double noise_sd = 0.3;        ///< receiver
  double hdop = 0.9;  ///< horizontal position error (both axes together) per range error
  double vdop = 1.4;  ///< vertical position error per range error
  double velocity_sd = 0.05;   ///< per axis, white: Doppler [m/s]
  OutageOptions outages = {};  ///< loss of fix
  double reacquisition = 5;    ///< from the end of an outage to the next fix [s]
};

/// What one source of range errors adds to a position.
struct GnssSource {
  double sd = 0;                ///< of the range error, after correction [m]
  double correlation_time = 0;  ///< [s]
};

/// The six sources of a receiver, corrected as its kind does: clock, orbit, ionosphere,
/// troposphere, multipath, noise.
///
///   source       correlation  left: single  differential  RTK
///   clock        1800 s             1         0            0
///   orbit        3600 s             1         0.02         0.001
///   ionosphere   1800 s             1         0.06         0.001
///   troposphere  3600 s             1         0.2          0.005
///   multipath      30 s             1         1            0.01
///   noise           1 s             1         1            0.01
///
/// Satellite errors change as their messages are renewed and satellites come and go; the
/// atmosphere with the path through it; multipath with the place of a moving antenna; the
/// noise is smoothed by the carrier. What a reference station leaves over is for one
/// within some 20 km (differential) or 5 km (RTK); RTK measures by the carrier's phase,
/// whose multipath and noise are a hundred times smaller.
std::array<GnssSource, 6> gnss_sources(const GnssReceiverOptions& options);

/// Satellite navigation receiver whose error is the sum of separate sources. Each is a
/// first-order Gauss-Markov process per axis (see GaussMarkovStep), of
///
///   sd_horizontal = sd hdop / sqrt(2) per axis,   sd_vertical = sd vdop
///
/// The stated standard deviations are those of the whole error. In an outage and until
/// reacquisition there is no fix; the errors wander on.
class GnssReceiver final : public PeriodicSensor<GnssReceiver, GnssFix> {
 public:
  /// @param instance  number among the equal sensors of this entity, from 0: each has
  ///                  errors of its own.
  GnssReceiver(const GnssReceiverOptions& options, std::uint64_t seed, EntityId entity,
               std::uint32_t instance = 0);

  bool measure(const SensorView& view, GnssFix& fix);

 private:
  FastNormals normal_;
  std::vector<GaussMarkov3> sources_;  // only those that are not zero
  GnssKind kind_;
  double horizontal_, vertical_;      // position error per range error
  double position_sd_, altitude_sd_;  // of the whole error [m]
  double velocity_sd_;
  Outages outages_;
  Time reacquisition_;
  Time blind_until_;
  std::uint8_t unit_;
};

}  // namespace skein::sensory
