// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::campaign {

/// `skein study estimators --cases`: evaluates rows of given quantities, one by one, so
/// that anybody can check the arithmetic.
///
/// In: columns kind, mu, sigma, lower, upper and, where used, sigma_v; others are
/// ignored. Out: those six and v1..v4 (empty where a kind has fewer), numbers in the
/// shortest form that reads back as the same double.
///
/// | kind | v1 | v2 | v3 | v4 |
/// |---|---|---|---|---|
/// | TN | mass of the interval | mean | variance | the misprinted variance (2.26) |
/// | MAP | most probable value | the MLE rule's value | | |
/// | UKF | lower clipped point | upper clipped point | their mean | |
/// | COV_MLE, COV_MAP, COV_UKF | z* | second moment about it | the misprinted one | |
///
/// MAP, COV_MLE and COV_MAP need sigma_v and one infinite bound. Where a COV_ row leaves
/// sigma_v empty, its z* is the given v1, or else comes with the sigma_v of the last row
/// that had one.
///
/// @param name  of the input, for messages.
/// @returns problems, each with place "name:line" and the column; if there are any,
///          nothing is written.
std::vector<Error> evaluate_cases(std::istream& in, const std::string& name,
                                  std::ostream& out);

/// `skein study estimators --updates`: whole QKF updates of one control point, without a
/// gate.
///
/// In: px, py, vx, vy, P00..P33 (upper triangle), ux, uy (aircraft), R (noise variance),
/// observed_in, expected_in (0 or 1); others are ignored.
/// Out: those, then lower, upper (the bounds), mu_a, S (predicted range and its
/// variance), z_mean, z_var (given the bounds), px1, py1, vx1, vy1, Q00..Q33 (posterior).
/// SI units. Parameters and result as for evaluate_cases().
std::vector<Error> evaluate_updates(std::istream& in, const std::string& name,
                                    std::ostream& out);

}  // namespace skein::campaign
