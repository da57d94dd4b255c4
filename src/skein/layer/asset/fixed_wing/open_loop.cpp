// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/fixed_wing/open_loop.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/model/atmosphere/atmosphere.h"

namespace skein::asset {
namespace {

OpenLoopInput between(const OpenLoopInput& a, const OpenLoopInput& b, double share) {
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  return {mix(a.t, b.t),
          {mix(a.surfaces.aileron, b.surfaces.aileron),
           mix(a.surfaces.elevator, b.surfaces.elevator),
           mix(a.surfaces.rudder, b.surfaces.rudder)},
          mix(a.thrust, b.thrust),
          a.wind_N + share * (b.wind_N - a.wind_N)};
}

Wrench wrench_at(const FixedWingModel& model, const Flow& flow, const Vec3& w_NB_B,
                 const OpenLoopInput& input, double altitude) {
  const double density = model::standard_air(altitude).density;
  return model.loads(flow, w_NB_B, input.surfaces, density, {input.thrust, 0});
}

OpenLoopOutput output_at(const FixedWingModel& model, const Motion& motion,
                         const OpenLoopInput& input) {
  const Vec3 v_AB_B = in_body(rotation(motion.q_NB), motion.v_N - input.wind_N);
  const Flow flow(v_AB_B);
  const Wrench wrench = wrench_at(model, flow, motion.w_NB_B, input, -motion.p_N.z());
  return {motion, flow.alpha, flow.beta, flow.airspeed,
          model.body.inverse_mass() * wrench.force_B};
}

}  // namespace

std::vector<OpenLoopOutput> fly_open_loop(const FixedWingModel& model,
                                          const Motion& start,
                                          std::span<const OpenLoopInput> inputs,
                                          const OpenLoopOptions& options) {
  SKEIN_CHECK(!inputs.empty() && options.longest_step > 0);
  Motion motion = start;
  std::vector<OpenLoopOutput> outputs;
  outputs.reserve(inputs.size());
  outputs.push_back(output_at(model, motion, inputs[0]));
  for (std::size_t i = 1; i < inputs.size(); ++i) {
    const OpenLoopInput &from = inputs[i - 1], &to = inputs[i];
    SKEIN_CHECK(to.t > from.t, from.t, to.t);
    const double duration = to.t - from.t;
    // A whole number of longest steps up to rounding stays that number.
    const double parts =
        std::max(1.0, std::ceil(duration / options.longest_step * (1 - 1e-9)));
    const double dt = duration / parts;
    for (double part = 0; part < parts; part += 1) {
      const auto loads_at = [&](const Stage& stage) {
        const OpenLoopInput input =
            between(from, to, (part + 0.5 * stage.halves) / parts);
        const Vec3 v_AB_B = in_body(stage.R_NB, stage.motion.v_N - input.wind_N);
        const double altitude = -stage.motion.p_N.z();
        const Wrench wrench =
            wrench_at(model, Flow(v_AB_B), stage.motion.w_NB_B, input, altitude);
        // 1 for the infinite radius.
        const double nearness = 1 / (1 + altitude / options.planet_radius);
        return Loads{wrench.force_B, wrench.moment_B, kGravity * nearness * nearness};
      };
      rk4_step(model.body, motion, dt, loads_at);
    }
    outputs.push_back(output_at(model, motion, to));
  }
  return outputs;
}

}  // namespace skein::asset
