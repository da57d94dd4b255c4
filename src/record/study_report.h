#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"

namespace skein::record {

/// One cell of a study's table: text, or a number (NaN shows as a dash).
struct StudyCell {
  std::variant<std::string, double> value;
  bool highlight = false;  ///< the best of its kind
};

struct StudyTable {
  std::string title, caption;
  std::vector<std::string> columns;          ///< headings, with units
  std::vector<std::vector<StudyCell>> rows;  ///< each as long as `columns`
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

struct StudyPlot {
  std::string title, caption;
  std::string x_label, y_label;  ///< with units
  bool log_x = false, log_y = false;
  std::vector<StudySeries> series;
  std::vector<StudyLevel> levels;
};

/// A page about a study: what was done, tables, plots, notes; paragraphs are plain text.
struct StudyReport {
  std::string title;
  std::vector<std::string> intro;
  std::vector<StudyTable> tables;
  std::vector<StudyPlot> plots;
  std::vector<std::string> notes;
};

/// Writes the study as one HTML file that needs no network, in the style of run reports.
/// Fails: kUnavailable when the file cannot be written.
Result<void> write_study_report(const StudyReport& report,
                                const std::filesystem::path& html);

}  // namespace skein::record
