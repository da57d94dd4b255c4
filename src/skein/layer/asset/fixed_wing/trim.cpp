// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/trim.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

// Unknowns: angle of attack, roll, elevator, aileron, thrust over weight, side-slip,
// rudder. Residuals: v', w' and what the ball shows; the last of both only with a rudder.
constexpr int kMax = 7;
using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMax, 1>;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMax, kMax>;

// Pitch at which the velocity through the air climbs as asked ([Stevens16], rate-of-climb
// constraint): sin(climb) = a sin(pitch) - b cos(pitch).
double pitch_for(double alpha, double beta, double roll, double climb_angle) {
  const double a = math::cos(alpha) * math::cos(beta);
  const double b = math::sin(roll) * math::sin(beta) +
                   math::cos(roll) * math::sin(alpha) * math::cos(beta);
  const double s = math::sin(climb_angle);
  return math::atan2(b, a) + math::asin(std::clamp(s / math::hypot(a, b), -1.0, 1.0));
}

class TrimProblem {
 public:
  TrimProblem(const FixedWingModel& model, const TrimRequest& request, TrimThrust thrust)
      : model_(model),
        request_(request),
        with_engine_(thrust == TrimThrust::kEngine),
        weight_(model.body.mass() * kGravity),
        density_(model::standard_air(request.altitude_msl).density),
        size_(model.servos.rudder_max > 0 ? 7 : 6) {}

  int size() const { return size_; }

  Unknowns first_guess() const {
    Unknowns x = Unknowns::Zero(size_);
    x[0] = 0.05;
    x[1] = math::atan(request_.turn_rate * request_.airspeed / kGravity);
    x[4] = math::sin(request_.climb_angle) + 0.1;
    return x;
  }

  Trim trim_of(const Unknowns& x) const {
    Trim t;
    t.alpha = x[0];
    t.roll = x[1];
    t.surfaces.elevator = x[2];
    t.surfaces.aileron = x[3];
    t.thrust = x[4] * weight_;
    t.beta = x[5];
    if (size_ == 7) t.surfaces.rudder = x[6];
    t.pitch = pitch_for(t.alpha, t.beta, t.roll, request_.climb_angle);
    t.v_AB_B = request_.airspeed * Vec3(math::cos(t.alpha) * math::cos(t.beta),
                                        math::sin(t.beta),
                                        math::sin(t.alpha) * math::cos(t.beta));
    t.w_NB_B = request_.turn_rate * down_in_body(t);
    if (with_engine_) t.spin = model_.engine.spin_for(t.thrust, t.v_AB_B.x(), density_);
    return t;
  }

  Unknowns residuals(const Trim& t) const {
    // The thrust as asked, which no engine needs to be able to give while searching.
    Engine::Output engine{t.thrust, 0};
    if (with_engine_)
      engine.torque = model_.engine.output(t.spin, t.v_AB_B.x(), density_).torque;
    const Wrench wrench =
        model_.loads(Flow(t.v_AB_B), t.w_NB_B, t.surfaces, density_, engine);
    const Vec3 specific = model_.body.inverse_mass() * wrench.force_B;
    Unknowns out(size_);
    out.head<3>() = specific + kGravity * down_in_body(t) - t.w_NB_B.cross(t.v_AB_B);
    out.segment<3>(3) = model_.body.angular_acceleration(t.w_NB_B, wrench.moment_B);
    if (size_ == 7) out[6] = specific.y();
    return out;
  }

  // The limit that `t` breaks first.
  TrimOutcome limits(const Trim& t) const {
    const Servos& servos = model_.servos;
    if (t.alpha >= model_.aero.peak().alpha) return TrimOutcome::kStalled;
    if (std::abs(t.surfaces.elevator) > servos.elevator_max)
      return TrimOutcome::kElevatorTooSmall;
    if (std::abs(t.surfaces.aileron) > servos.aileron_max)
      return TrimOutcome::kAileronTooSmall;
    if (std::abs(t.surfaces.rudder) > servos.rudder_max)
      return TrimOutcome::kRudderTooSmall;
    if (!with_engine_) return TrimOutcome::kFound;
    // What a Newton step leaves over counts as no thrust.
    const bool pulls = t.thrust > 1e-9 * weight_;
    if (pulls && (!model_.engine.exists() || t.throttle > 1))
      return TrimOutcome::kThrustTooSmall;
    return t.thrust < -1e-9 * weight_ ? TrimOutcome::kThrustNegative
                                      : TrimOutcome::kFound;
  }

  // Whether the wing cannot even carry the weight, more of it in a turn.
  bool too_slow() const {
    const double V = request_.airspeed;
    const double across = request_.turn_rate * V / kGravity;
    const double lift =
        weight_ * math::cos(request_.climb_angle) * math::hypot(1, across);
    return lift > 0.5 * density_ * V * V * model_.wing_area *
                      model_.aero.peak().lift_coefficient;
  }

  void add_engine(Trim& t) const {
    if (!with_engine_) return;
    t.throttle = model_.engine.throttle_for(t.spin, t.v_AB_B.x(), density_);
    t.power = model_.engine.power(t.spin, t.v_AB_B.x(), density_);
  }

 private:
  static Vec3 down_in_body(const Trim& t) {
    return {-math::sin(t.pitch), math::sin(t.roll) * math::cos(t.pitch),
            math::cos(t.roll) * math::cos(t.pitch)};
  }

  const FixedWingModel& model_;
  const TrimRequest& request_;
  bool with_engine_;
  double weight_, density_;
  int size_;
};

Jacobian slopes(const TrimProblem& problem, const Unknowns& x) {
  constexpr double kStep = 1e-6;
  Jacobian J(problem.size(), problem.size());
  for (int k = 0; k < problem.size(); ++k) {
    Unknowns ahead = x, behind = x;
    ahead[k] += kStep;
    behind[k] -= kStep;
    J.col(k) = (problem.residuals(problem.trim_of(ahead)) -
                problem.residuals(problem.trim_of(behind))) /
               (2 * kStep);
  }
  return J;
}

}  // namespace

TrimResult find_trim(const FixedWingModel& model, const TrimRequest& request,
                     TrimThrust thrust) {
  // Accelerations of a balanced aircraft [m/s^2, rad/s^2]: far below what is felt, well
  // above rounding.
  constexpr double kBalanced = 1e-9;
  const TrimProblem problem(model, request, thrust);
  Unknowns x = problem.first_guess();
  Unknowns left = problem.residuals(problem.trim_of(x));
  for (int round = 0; round < 50; ++round) {
    if (left.lpNorm<Eigen::Infinity>() < 1e-12) break;
    const Unknowns step = slopes(problem, x).colPivHouseholderQr().solve(left);
    if (!step.allFinite()) break;
    // No angle moves by more than this in one go; then the step is halved until it helps.
    double share = std::min(1.0, 0.2 / step.lpNorm<Eigen::Infinity>());
    bool better = false;
    for (int halving = 0; halving < 20 && !better; ++halving, share /= 2) {
      const Unknowns next = x - share * step;
      const Unknowns next_left = problem.residuals(problem.trim_of(next));
      if (next_left.norm() < left.norm()) {
        x = next;
        left = next_left;
        better = true;
      }
    }
    if (!better) break;
  }
  TrimResult result;
  result.trim = problem.trim_of(x);
  problem.add_engine(result.trim);
  result.trim.residual = left.lpNorm<Eigen::Infinity>();
  if (result.trim.residual < kBalanced)
    result.outcome = problem.limits(result.trim);
  else if (problem.too_slow())
    result.outcome = TrimOutcome::kStalled;
  return result;
}

std::string reason(const FixedWingModel& model, const TrimResult& result) {
  const Trim& t = result.trim;
  const auto surface = [](const char* name, double needed, double largest) {
    return fmt::format("needs {:.1f} deg of {}, has {:.1f} deg", geo::degrees(needed),
                       name, geo::degrees(largest));
  };
  switch (result.outcome) {
    case TrimOutcome::kFound:
      return "";
    case TrimOutcome::kNoBalance:
      return fmt::format("forces and moments cannot be balanced ({:.3g} m/s^2 is left)",
                         t.residual);
    case TrimOutcome::kStalled:
      return fmt::format("the wing stalls, at an angle of attack of {:.1f} deg",
                         geo::degrees(model.aero.peak().alpha));
    case TrimOutcome::kElevatorTooSmall:
      return surface("elevator", t.surfaces.elevator, model.servos.elevator_max);
    case TrimOutcome::kAileronTooSmall:
      return surface("aileron", t.surfaces.aileron, model.servos.aileron_max);
    case TrimOutcome::kRudderTooSmall:
      return surface("rudder", t.surfaces.rudder, model.servos.rudder_max);
    case TrimOutcome::kThrustTooSmall:
      return fmt::format("needs {:.3g} N of thrust, which is more than there is",
                         t.thrust);
    case TrimOutcome::kThrustNegative:
      return fmt::format("needs to be braked by {:.3g} N", -t.thrust);
  }
  return "";
}

Motion trimmed_motion(const Trim& trim, const Vec3& p_N, double yaw, const Vec3& wind_N) {
  Motion motion;
  motion.p_N = p_N;
  motion.q_NB = geo::from_euler({trim.roll, trim.pitch, yaw});
  motion.v_N = rotation(motion.q_NB) * trim.v_AB_B + wind_N;
  motion.w_NB_B = trim.w_NB_B;
  return motion;
}

}  // namespace skein::asset
