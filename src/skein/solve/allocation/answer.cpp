// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/answer.h"

#include <algorithm>
#include <cmath>

namespace skein::solve {

double Quality::gap() const {
  if (proven) return 0;
  const double larger = std::max(std::abs(value), std::abs(bound));
  return larger > 0 ? std::abs(bound - value) / larger : 0;
}

bool is_worth_changing(double present, double found, bool tasks_or_aircraft_changed,
                       double share) {
  if (tasks_or_aircraft_changed) return found > present;
  return found - present > share * std::abs(present);
}

}  // namespace skein::solve
