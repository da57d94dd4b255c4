// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "skein/base/result.h"

namespace skein::record {

/// One cell of a study's table: text, or a number (NaN shows as a dash).
struct TableCell {
  std::variant<std::string, double> value;
  bool highlight = false;  ///< the best of its kind
};

struct StudyTable {
  std::string title, caption;
  std::vector<std::string> columns;          ///< headings, with units
  std::vector<std::vector<TableCell>> rows;  ///< each as long as `columns`
};

/// One line or cloud of points. NaN in `y` leaves a gap.
struct StudySeries {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low, high;  ///< a band around the line; empty = none
  bool dashed = false;
  bool points = false;  ///< points instead of a line
};

/// A horizontal line for comparison.
struct StudyLevel {
  double y = 0;
  std::string label;
};

/// A value with its confidence interval; NaN when there is none.
struct StudyDot {
  double value = 0;
  double low = 0, high = 0;
};

/// Values of every pair of a row and a series, compared along one axis.
struct StudyDots {
  std::string title, caption;
  std::string x_label;  ///< with unit
  bool log_x = false;
  std::vector<std::string> rows, series;
  std::vector<std::vector<StudyDot>> dots;  ///< by row, then by series
};

struct StudyPlot {
  std::string title, caption;
  std::string x_label, y_label;  ///< with units
  bool log_x = false, log_y = false;
  std::vector<StudySeries> series;
  std::vector<StudyLevel> levels;
  double y_low = kFree, y_high = kFree;  ///< ends of the axis; NaN = as the lines need
  static constexpr double kFree = std::numeric_limits<double>::quiet_NaN();
};

/// Tracks over ground, x = east and y = north [m], drawn north up with equal axes. What
/// is dashed is what the others are compared with.
struct StudyMap {
  std::string title, caption;
  std::vector<StudySeries> series;
};

/// A page about a study: what was done, tables, plots, notes; paragraphs are plain text.
struct StudyReport {
  std::string title;
  std::string alert;  ///< shown first, so that nobody misses it; empty = none
  std::vector<std::string> intro;
  std::vector<StudyTable> tables;
  std::vector<StudyDots> dots;
  std::vector<StudyPlot> plots;
  std::vector<StudyMap> maps;
  std::vector<std::string> notes;
};

/// Writes the study as one HTML file that needs no network, in the style of run reports.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_study_report(const StudyReport& report,
                                const std::filesystem::path& html);

}  // namespace skein::record
