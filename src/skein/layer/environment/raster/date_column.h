// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/layer/environment/raster/date_time.h"

namespace skein::environment {

/// How the texts of one column or attribute are read.
struct DateColumnOptions {
  std::optional<DateOrder> order = {};  ///< none: the one that the texts show
  bool plain_seconds = false;           ///< numbers are seconds, however large
  bool numbers = true;                  ///< else a number is no time
};

/// The times of one column or attribute.
struct DateColumn {
  std::vector<std::optional<DateTime>> times;  ///< of each text; none: it means no time
  std::optional<std::size_t> wrong;  ///< the first text that is neither a time nor none
  std::size_t wrong_count = 0;       ///< how many such texts there are
  std::size_t null_count = 0;        ///< dates and numbers that mean "none"
  std::string first_null;            ///< the first of them
  std::vector<std::string> understood;  ///< what was assumed to read them, as sentences
};

/// Reads dates that belong together: what one of them shows holds for all.
///
/// - *Order*: of the orders of day, month and year that give most texts a meaning, the
///   one in which all times lie closest together; of equals the month stands first.
/// - *None*: empty texts and words for it (`null`, `n/a`, `0000-00-00`...); dates that
///   programs write for "no date": up to 1900-01-02 (30.12.1899, 1.1.1900, the year 1),
///   1970-01-01 to within 14 hours on a quarter of an hour, and from 2200 on
///   (9999-12-31); the numbers 0 and -1 among dates.
/// - *Numbers*, unless `plain_seconds`: if all lie from 36526 to 55152, days of a
///   spreadsheet (2000 to 2050); if all have seven digits and are such, a year and the
///   day in it (2021248); else as parse_date_or_number().
///
/// @param name  of the column, for `understood`.
DateColumn read_date_column(std::span<const std::string> texts, const std::string& name,
                            const DateColumnOptions& options);

/// Whether a text is empty or a word for "none".
bool means_none(std::string_view text);

/// Adds `fresh` lines to `lines`, each once.
void add_once(std::vector<std::string>& lines, const std::vector<std::string>& fresh);

}  // namespace skein::environment
