// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/wind/series_wind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/base/csv.h"
#include "skein/layer/environment/wind/uniform_wind.h"

namespace skein::environment {
namespace {

constexpr double kLongest = 1e9;  // [s], some 30 years

constexpr std::array<std::string_view, 5> kColumns = {"t_s", "speed_mps", "from_deg",
                                                      "north_mps", "east_mps"};

Result<SeriesWind> from_table(const CsvTable& table, const std::string& place) {
  if (auto unique = table.check_unique(kColumns); !unique) return unique.error();
  const auto time = table.column("t_s");
  const auto speed = table.column("speed_mps"), from = table.column("from_deg");
  const auto north = table.column("north_mps"), east = table.column("east_mps");
  const bool polar = speed && from;
  if (!time || (!polar && !(north && east)))
    return Error{ErrorCode::kBadInput, place, "lacks columns of a wind series",
                 "t_s and either speed_mps, from_deg or north_mps, east_mps are needed"};
  if (table.size() == 0)
    return Error{ErrorCode::kBadInput, place, "has a header but no rows", ""};
  std::vector<SeriesWind::Entry> entries;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const auto t = table.number(row, *time);
    const auto a = table.number(row, polar ? *speed : *north);
    const auto b = table.number(row, polar ? *from : *east);
    for (const auto* field : {&t, &a, &b})
      if (!field->ok()) return field->error();
    const auto error = [&](const std::string& message) {
      return Error{ErrorCode::kBadInput, table.place(row), message, ""};
    };
    if (std::abs(t.value()) > kLongest)
      return error(fmt::format("t_s: {} is outside -1e9 to 1e9", t.value()));
    if (polar && a.value() < 0)
      return error(fmt::format("speed_mps: {} must not be below 0", a.value()));
    const Time at = Time::from_seconds(t.value());
    if (!entries.empty() && at <= entries.back().time)
      return error(fmt::format("t_s: {} is not above the one before, {}", t.value(),
                               entries.back().time.seconds()));
    entries.push_back({at, polar ? blowing_from(a.value(), geo::radians(b.value()))
                                 : Vec2(a.value(), b.value())});
  }
  return SeriesWind(std::move(entries));
}

}  // namespace

SeriesWind::SeriesWind(std::vector<Entry> entries) : entries_(std::move(entries)) {
  SKEIN_CHECK(!entries_.empty());
  for (std::size_t i = 1; i < entries_.size(); ++i)
    SKEIN_CHECK(entries_[i - 1].time < entries_[i].time, i);
}

Result<SeriesWind> SeriesWind::load(const std::string& path) {
  const auto table = CsvTable::load(path);
  if (!table) return table.error();
  return from_table(table.value(), path);
}

Result<SeriesWind> SeriesWind::parse(std::string_view text, const std::string& place) {
  const auto table = CsvTable::parse(text, place);
  if (!table) return table.error();
  return from_table(table.value(), place);
}

Vec3 SeriesWind::wind(const Vec3&, Time time) const {
  const auto after =
      std::upper_bound(entries_.begin(), entries_.end(), time,
                       [](Time t, const Entry& entry) { return t < entry.time; });
  Vec3 result = Vec3::Zero();
  if (after == entries_.begin()) {
    result.head<2>() = entries_.front().velocity;
  } else if (after == entries_.end()) {
    result.head<2>() = entries_.back().velocity;
  } else {
    const Entry& before = *(after - 1);
    const double part =
        (time - before.time).seconds() / (after->time - before.time).seconds();
    result.head<2>() = before.velocity + part * (after->velocity - before.velocity);
  }
  return result;
}

Result<std::unique_ptr<WindField>> make_series_wind(const SeriesWindOptions& options) {
  auto series = SeriesWind::load(options.file);
  if (!series) return series.error();
  return std::unique_ptr<WindField>(
      std::make_unique<SeriesWind>(std::move(series).value()));
}

}  // namespace skein::environment
