// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/geo/vec.h"

namespace skein::reasoning {

/// A line of a survey that is still to be flown.
struct SurveyLine {
  Vec2 begin = Vec2::Zero(), end = Vec2::Zero();  ///< [m]
  int missed = 0;  ///< times that it was flown too far aside
};

/// What is left of a survey: lines in the order in which they are flown, and what of them
/// no-fly zones forbid.
class SurveyLines {
 public:
  /// @param ends  begin and end of each line.
  explicit SurveyLines(std::span<const Vec2> ends);

  /// Lines and parts of lines that can be flown now.
  const std::vector<SurveyLine>& left() const { return left_; }

  /// Those within zones.
  const std::vector<SurveyLine>& forbidden() const { return forbidden_; }

  double length_left() const;                           ///< of these [m]
  double length() const { return length_; }             ///< of all at the beginning [m]
  double length_forbidden() const;                      ///< within zones [m]
  double length_given_up() const { return given_up_; }  ///< missed twice [m]

  /// Other zones count from now on: parts of lines within them, and where they leave no
  /// room to turn at the end of a line, are put aside; others come back, behind those
  /// that are left.
  /// @param zones        with the margin that is kept from them.
  /// @param turn_radius  over ground [m].
  void regard(std::span<const Zone> zones, double turn_radius);

  /// The first line has been flown.
  void flown();
  /// The first line was flown too far aside, or left out: it is flown again at the end,
  /// once, then given up.
  void missed();
  /// The first line has been flown up to a place on it.
  void flown_to(const Vec2& place);

 private:
  std::vector<SurveyLine> left_;
  std::vector<SurveyLine> forbidden_;
  double length_ = 0, given_up_ = 0;
};

}  // namespace skein::reasoning
