// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/result.h"
#include "skein/role/wind_field.h"

namespace skein::environment {

struct SeriesWindOptions {
  std::string file;  ///< CSV: t_s and either speed_mps, from_deg or north_mps, east_mps
};

/// A wind that changes with time only, the same everywhere. Between two entries its
/// north and east components are linear in time (never its angle); before the first and
/// after the last entry it holds.
class SeriesWind final : public WindField {
 public:
  struct Entry {
    Time time;
    Vec2 velocity = Vec2::Zero();  ///< where the air goes [m/s]
  };
  /// Fails: Bug when `entries` is empty or its times do not grow.
  explicit SeriesWind(std::vector<Entry> entries);

  /// Reads the table of SeriesWindOptions; `north_mps`, `east_mps` say where the air goes
  /// to, `from_deg` where it comes from.
  /// Fails: kNotFound; kBadInput: no rows, columns missing, a field that is no finite
  ///        number, a negative speed, times that do not grow.
  static Result<SeriesWind> load(const std::string& path);
  static Result<SeriesWind> parse(std::string_view text, const std::string& place);

  Vec3 wind(const Vec3& p_N, Time time) const override;

 private:
  std::vector<Entry> entries_;
};

Result<std::unique_ptr<WindField>> make_series_wind(const SeriesWindOptions& options);

}  // namespace skein::environment
