// Turbulence: one row each.

#include "assemble/kinds_of.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

struct NoTurbulence {};

}  // namespace

Kinds<Turbulence, AircraftContext> turbulence_kinds() {
  using Made = Result<std::unique_ptr<Turbulence>>;
  Kinds<Turbulence, AircraftContext> kinds("turbulence");
  kinds.add("none", "The mean wind only.", Fields<NoTurbulence>(),
            [](const NoTurbulence&, const AircraftContext&) -> Made {
              return std::unique_ptr<Turbulence>();
            });
  return kinds;
}

}  // namespace skein::assemble
