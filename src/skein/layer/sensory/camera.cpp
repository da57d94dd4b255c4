// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/sensory/camera.h"

#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/sensory/ray_cast.h"

namespace skein::sensory {
namespace {

// Nearer than this to an object, the ground that a ray meets is the object's own [m].
constexpr double kOwnGround = 2;

bool hidden(const SensorView& view, const Vec3& to_object_N, double distance) {
  const double free = distance - kOwnGround;
  return free > 0 &&
         ray_cast(view.terrain, view.vehicle.p_N, to_object_N / distance, free)
             .has_value();
}

}  // namespace

Camera::Camera(const CameraOptions& options, std::uint64_t seed, EntityId entity,
               std::uint32_t instance)
    : options_(options),
      right_(math::tan(options.width / 2)),
      front_(math::tan(options.length / 2)),
      cos_tilt_(math::cos(options.max_tilt)),
      sin_tilt_(math::sin(options.max_tilt)),
      clock_(options.rate_hz),
      footprints_(options.latency, clock_.period()),
      detections_(options.latency, clock_.period()),
      random_(seed, entity.value, Purpose::kCamera, instance) {}

void Camera::sample(const SensorView& view, std::vector<SensorSample>& out) {
  if (clock_.due(view.now)) {
    footprints_.put(footprint(view), out);
    find_objects(view, out);
  }
  footprints_.release(view.now, out);
  detections_.release(view.now, out);
}

Quat Camera::attitude(const SensorView& view) const {
  const Quat& q_NB = view.vehicle.q_NB;
  if (!options_.gimbal) return q_NB;
  const Quat down = geo::from_euler({0, 0, geo::to_euler(q_NB).yaw});
  if (!view.gaze_N || view.gaze_N->norm() < kOwnGround) return down;
  Vec3 gaze = view.gaze_N->normalized();
  const double across = geo::horizontal(gaze).norm();
  if (gaze.z() < cos_tilt_ && across > 0)
    gaze = {sin_tilt_ * gaze.x() / across, sin_tilt_ * gaze.y() / across, cos_tilt_};
  if (gaze.z() < cos_tilt_) return down;  // straight up
  // The shortest turn that takes the down axis there.
  const Quat tilt = Quat(1 + gaze.z(), -gaze.y(), gaze.x(), 0).normalized();
  return tilt * down;
}

FootprintSample Camera::footprint(const SensorView& view) const {
  FootprintSample sample{view.now};
  const Quat q_NS = attitude(view);
  const std::array<Vec3, 4> corners_B{{{front_, -right_, 1},
                                       {front_, right_, 1},
                                       {-front_, right_, 1},
                                       {-front_, -right_, 1}}};
  for (std::size_t i = 0; i < corners_B.size(); ++i) {
    const Vec3 ray_N = q_NS * corners_B[i].normalized();
    const double distance =
        ray_cast(view.terrain, view.vehicle.p_N, ray_N, options_.range)
            .value_or(options_.range);
    sample.corners[i] = distance * geo::horizontal(ray_N);
  }
  return sample;
}

void Camera::find_objects(const SensorView& view, std::vector<SensorSample>& out) {
  const Quat q_SN = attitude(view).conjugate();
  for (const VisibleObject& object : view.objects) {
    const Vec2& at = object.position;
    const Vec3 object_N{at.x(), at.y(), -view.terrain.elevation_msl(at)};
    const Vec3 away_N = object_N - view.vehicle.p_N;
    const double distance = away_N.norm();
    const Vec3 away_B = q_SN * away_N;
    if (distance > options_.range || away_B.z() <= 0 ||
        std::abs(away_B.x()) > front_ * away_B.z() ||
        std::abs(away_B.y()) > right_ * away_B.z() || hidden(view, away_N, distance))
      continue;
    if (random_.uniform() >= options_.detection) continue;
    const double sd = math::hypot(options_.position_sd, options_.direction_sd * distance);
    DetectionSample found{view.now, object.id, geo::horizontal(away_N), sd, object.what};
    const double north = random_.normal(), east = random_.normal();
    found.position += sd * Vec2(north, east);
    detections_.put(found, out);
  }
}

}  // namespace skein::sensory
