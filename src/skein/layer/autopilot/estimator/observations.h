// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/autopilot/estimator/error_covariance.h"
#include "skein/layer/autopilot/estimator/error_state.h"

namespace skein::autopilot {

/// What a measurement should say for a state, and how that changes with the error:
/// predicted(corrected(x, e)) = value + row e + O(e^2).
struct Observation {
  double value = 0;
  SparseRow row;
};

/// The motion at a fix that comes late.
struct Past {
  Vec3 p_N = Vec3::Zero();     ///< position then [m]
  Vec3 v_N = Vec3::Zero();     ///< velocity then [m/s]
  double delay = 0;            ///< how long ago [s]
  Vec3 gained = Vec3::Zero();  ///< velocity that the specific force has given since [m/s]
};

/// Position in a fix along an axis of N, without the noise of the fix.
Observation observe_position(const Navigated& x, const Past& past, int axis);

/// Velocity in a fix along an axis of N.
Observation observe_velocity(const Navigated& x, const Past& past, int axis);

/// Pressure altitude [m].
Observation observe_altitude(const Navigated& x);

/// Bearing [rad] of the horizontal field that the magnetometer shows by the estimated
/// attitude and bias, when the true field is `field_N`: the declination without errors.
/// Only the heading is asked, so that a field that dips otherwise than expected does not
/// tilt the estimate. The field must not be the sample itself: noise that is in the
/// gradient and in the innovation at once would pull the estimate.
Observation observe_bearing(const Navigated& x, const Vec3& field_N);

/// Reading of the pitot tube in the mean wind [m/s].
Observation observe_airspeed(const Navigated& x);

/// Reading of the pitot tube where the air may come from far aside: the part ahead, in
/// the mean wind [m/s]. The attitude counts as known.
Observation observe_airspeed_ahead(const Navigated& x);

/// Velocity through the mean wind along the right wing [m/s]; its true value is 0 without
/// side-slip and gusts.
Observation observe_sideslip(const Navigated& x);

/// Mean wind [m/s] along an axis of N (0 or 1) that an on-board anemometer shows by the
/// estimated velocity and attitude.
Observation observe_wind(const Navigated& x, int axis);

}  // namespace skein::autopilot
