// SPDX-License-Identifier: Apache-2.0
// Turbulence: one row each.

#include <optional>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/layer/environment/turbulence/dryden_turbulence.h"

namespace skein::assemble {
namespace {

using environment::DrydenOptions;
using environment::TurbulenceIntensity;
using scenario::Fields;

struct NoTurbulence {};

struct DrydenChoice : DrydenOptions {
  std::optional<double> own_span;  // [m]; none: of each aircraft
};

Fields<DrydenChoice> dryden_fields() {
  using T = DrydenChoice;
  return Fields<T>()
      .word("intensity", &T::intensity, "How rough the air is.",
            {{"light", TurbulenceIntensity::kLight, "wind of 15 kt near the ground"},
             {"moderate", TurbulenceIntensity::kModerate, "30 kt"},
             {"severe", TurbulenceIntensity::kSevere, "45 kt"}})
      .number(
          "wind20_mps", &T::wind20,
          "Wind 20 ft above the ground instead; 0: no turbulence. Null: as intensity.",
          {.at_least = 0, .at_most = 60})
      .number("span_m", &T::own_span,
              "Wing span, or size, of the aircraft. Null: that of each aircraft's plant, "
              "2 m for kinematic ones.",
              {.above = 0, .at_most = 100});
}

}  // namespace

Kinds<Turbulence, AircraftContext> turbulence_kinds() {
  using Made = Result<std::unique_ptr<Turbulence>>;
  Kinds<Turbulence, AircraftContext> kinds("turbulence");
  kinds.add("none", "The mean wind only.", Fields<NoTurbulence>(),
            [](const NoTurbulence&, const AircraftContext&) -> Made {
              return std::unique_ptr<Turbulence>();
            });
  kinds.add("dryden",
            "Dryden's, after MIL-F-8785C: gusts and rates by height and airspeed.",
            dryden_fields(), [](const DrydenChoice& o, const AircraftContext& c) {
              DrydenOptions all = o;
              const double span = o.own_span.value_or(span_of(c.airframe));
              if (span > 0) all.span = span;
              return std::make_unique<environment::DrydenTurbulence>(all, c.seed, c.self);
            });
  return kinds;
}

}  // namespace skein::assemble
