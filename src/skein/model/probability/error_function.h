// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::model::cody {

// The three rational approximations of [Cody69], as plain inline functions, because a
// call and a branch each cost a good part of what a measurement update may take.

inline constexpr double kSmall = 0.46875;  ///< erf() below, scaled erfc above [-]
inline constexpr double kLarge = 4;        ///< beyond: expansion in 1/x^2

/// erf(x) for |x| <= kSmall.
inline double erf_small(double x) {
  const double y = x * x;
  const double above = (((1.85777706184603153e-1 * y + 3.16112374387056560e0) * y +
                         1.13864154151050156e2) *
                            y +
                        3.77485237685302021e2) *
                           y +
                       3.20937758913846947e3;
  const double below = (((y + 2.36012909523441209e1) * y + 2.44024637934444173e2) * y +
                        1.28261652607737228e3) *
                           y +
                       2.84423683343917062e3;
  return x * above / below;
}

/// exp(x^2) erfc(x) = above/below for kSmall <= x <= kLarge.
struct Ratio {
  double above;
  double below;
};
inline Ratio erfcx_middle(double x) {
  // Even and odd powers apart: two short chains of operations instead of a long one.
  const double y = x * x;
  const double above_even = (((2.15311535474403846e-8 * y + 8.88314979438837594e0) * y +
                              2.98635138197400131e2) *
                                 y +
                             1.71204761263407058e3) *
                                y +
                            1.23033935479799725e3;
  const double above_odd =
      ((5.64188496988670089e-1 * y + 6.61191906371416295e1) * y + 8.81952221241769090e2) *
          y +
      2.05107837782607147e3;
  const double below_even =
      (((y + 1.17693950891312499e2) * y + 1.62138957456669019e3) * y +
       4.36261909014324716e3) *
          y +
      1.23033935480374942e3;
  const double below_odd =
      ((1.57449261107098347e1 * y + 5.37181101862009858e2) * y + 3.29079923573345963e3) *
          y +
      3.43936767414372164e3;
  return {above_even + x * above_odd, below_even + x * below_odd};
}

/// The t in exp(x^2) erfc(x) = (1 - t)/(x sqrt(pi)), for x >= kLarge. It is about
/// 1/(2 x^2), and having it apart keeps what later differences need.
inline double deficit_large(double x) {
  constexpr double kSqrtPi = 1.7724538509055160273;
  const double y = 1 / (x * x);
  const double above = ((((1.63153871373020978e-2 * y + 3.05326634961232344e-1) * y +
                          3.60344899949804439e-1) *
                             y +
                         1.25781726111229246e-1) *
                            y +
                        1.60837851487422766e-2) *
                           y +
                       6.58749161529837803e-4;
  const double below = ((((y + 2.56852019228982242e0) * y + 1.87295284992346725e0) * y +
                         5.27905102951428412e-1) *
                            y +
                        6.05183413124413191e-2) *
                           y +
                       2.33520497626869185e-3;
  return kSqrtPi * y * above / below;
}

}  // namespace skein::model::cody
