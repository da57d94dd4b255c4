// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::perimeter {

/// The compactly supported correlation function of [Gaspari99] Eq. (4.10).
/// @param ratio  distance over half the support, not negative.
/// @returns 1 at 0, 0 from 2 on, twice continuously differentiable.
inline double gaspari_cohn(double ratio) {
  const double z = ratio;
  if (z >= 2) return 0;
  if (z <= 1) return (((-0.25 * z + 0.5) * z + 0.625) * z - 5.0 / 3) * z * z + 1;
  return ((((z / 12 - 0.5) * z + 0.625) * z + 5.0 / 3) * z - 5) * z + 4 - 2 / (3 * z);
}

}  // namespace skein::perimeter
