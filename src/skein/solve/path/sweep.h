// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/vehicle/flight_plan.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/box_forest.h"

namespace skein::solve {

/// A span of time [s]; empty when it ends before it begins.
struct Span {
  double begin = 0, end = 0;
  bool empty() const { return end < begin; }
  Span cut(const Span& other) const;
};

/// Distance of a point from a straight piece [m].
double distance(const Vec2& p, const Vec2& a, const Vec2& b);
/// Distance of two straight pieces [m], 0 where they cross.
double distance(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Distance of a point from the path of an element [m] between two times after its start;
/// exact. Valid: without wind.
double distance_without_wind(const Vec2& p, const FlightElement& e, const Span& after);

/// How far an element's path may be beside its chord over a time h [m]: the acceleration,
/// which is V r everywhere, times h^2 / 8.
double chord_error(const FlightElement& e, double h);
/// The same above or below it [m].
double vertical_chord_error(const FlightElement& e, double h);

/// A box around all of an element, tight for straights.
Box box_of(const FlightElement& e);

/// The first and the last time after the element's start, while it lasts, at which its
/// altitude is within a range. The altitude of the range's ends may grow at `rate` [m/s].
Span within_altitudes(const FlightElement& e, double low, double high, double rate = 0);

/// Chords nearer to their curve than this decide [m].
inline constexpr double kChordError = 0.03;

/// The first time at which something that moves along a curve comes too near: pieces of
/// the curve are halved until their chords, which are off by `error` of their duration at
/// most, decide.
///
/// @param gap    (Span, begin, end) -> how far the chord is at least from what is to be
///               kept from [m], negative inside.
/// @param span   times after the element's start; not empty.
/// @param depth  what may be entered [m].
/// @param leaf   no piece longer than this is called too near [s].
/// @returns      the begin of the first piece that is too near; negative if none is. What
///               is none stays out by -depth, whatever the curve. What is one may, over a
///               piece, be nearer by chord error and motion only.
template <class Gap>
double first_near(const FlightElement& e, const Span& span, const Vec3& begin,
                  const Vec3& end, double depth, double leaf, const Gap& gap) {
  const double h = span.end - span.begin;
  const double error = chord_error(e, h);
  if (gap(span, begin, end) - error >= -depth) return -1;
  if (error <= kChordError && h <= leaf) return span.begin;
  const double half = (span.begin + span.end) / 2;
  const Vec3 middle = model::position(e, half);
  const double first =
      first_near(e, Span{span.begin, half}, begin, middle, depth, leaf, gap);
  if (first >= 0) return first;
  return first_near(e, Span{half, span.end}, middle, end, depth, leaf, gap);
}

}  // namespace skein::solve
