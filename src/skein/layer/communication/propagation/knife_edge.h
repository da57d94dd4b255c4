// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::communication {

/// Loss behind a sharp edge across a path [dB].
///
///   J(v) = 6.9 + 20 log10(sqrt((v - 0.1)^2 + 1) + v - 0.1),   0 for v <= -0.78
///
/// @param v  Fresnel's parameter of diffraction: 0 when the edge touches the straight
///           line, above 0 when it stands out over it
/// Reference: [P526] Eq. (31).
double knife_edge_loss_db(double v);

/// Fresnel's parameter of an edge.
///
///   v = h sqrt(2 / wavelength (1/d1 + 1/d2))
///
/// @param height  h, over the straight line; below 0: under it [m]
/// @param d1, d2  from the edge to the ends, above 0 [m]
/// Reference: [P526] Eq. (26).
double fresnel_parameter(double height, double d1, double d2, double wavelength);

}  // namespace skein::communication
