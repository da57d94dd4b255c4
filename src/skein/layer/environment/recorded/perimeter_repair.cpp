// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/perimeter_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "skein/geo/clip.h"

namespace skein::environment {
namespace {

using geo::FillRule;
using geo::Region;
using geo::Ring;

constexpr double kFarthest = 500e3;  // [m]
constexpr double kJoin = 1.0;        // ends of lines that meet within this are one [m]

std::vector<Vec2> without_repeats(const std::vector<Vec2>& points) {
  std::vector<Vec2> result;
  for (const Vec2& p : points)
    if (result.empty() || result.back() != p) result.push_back(p);
  while (result.size() > 1 && result.back() == result.front()) result.pop_back();
  return result;
}

void append(Region& rings, const Region& more) {
  rings.insert(rings.end(), more.begin(), more.end());
}

// Joins lines end to end, in the order given, reversing them where that helps.
std::vector<std::vector<Vec2>> joined_lines(std::vector<std::vector<Vec2>> lines) {
  std::erase_if(lines, [](const auto& line) { return line.empty(); });
  std::vector<std::vector<Vec2>> result;
  std::vector<bool> used(lines.size(), false);
  const auto near = [](const Vec2& a, const Vec2& b) { return (a - b).norm() <= kJoin; };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (used[i]) continue;
    std::vector<Vec2> chain = lines[i];
    for (bool grown = true; grown && !near(chain.front(), chain.back());) {
      grown = false;
      for (std::size_t j = i + 1; j < lines.size() && !grown; ++j) {
        std::vector<Vec2>& next = lines[j];
        if (used[j] || near(next.front(), next.back())) continue;
        if (near(chain.back(), next.back()) || near(chain.front(), next.front()))
          std::reverse(next.begin(), next.end());
        if (near(chain.back(), next.front()))
          chain.insert(chain.end(), next.begin(), next.end());
        else if (near(next.back(), chain.front()))
          chain.insert(chain.begin(), next.begin(), next.end());
        else
          continue;
        used[j] = grown = true;
      }
    }
    result.push_back(std::move(chain));
  }
  return result;
}

class Repair {
 public:
  Repair(const std::string& place, const RepairOptions& options,
         std::vector<std::string>& warnings)
      : place_(place), options_(options), warnings_(warnings) {}

  Region region(const RawPerimeter& raw) {
    Region rings = enclosed_by(raw.lines);
    for (const RawPolygon& polygon : raw.polygons) append(rings, area_of(polygon));
    // Each part winds once around its inside and not at all around its holes: what has a
    // positive number of turns is their union.
    Region result = geo::clean(rings, FillRule::kPositive);
    const std::size_t parts = result.size();
    std::erase_if(result, [&](const Ring& ring) {
      return std::abs(geo::signed_area(ring)) < options_.min_part;
    });
    if (result.size() < parts)
      warn(fmt::format("{} part{} or hole{} below {} m2 left out", parts - result.size(),
                       parts - result.size() == 1 ? "" : "s",
                       parts - result.size() == 1 ? "" : "s", options_.min_part));
    return result;
  }

 private:
  void warn(const std::string& text) { warnings_.push_back(place_ + ": " + text); }

  // What one ring winds around; empty, with a warning, when that is nothing.
  Region inside_of(const std::vector<Vec2>& points, const char* what) {
    const Ring ring = without_repeats(points);
    Region region = ring.size() < 3 ? Region{} : geo::clean({ring}, FillRule::kNonZero);
    if (region.empty()) {
      warn(fmt::format("{} of {} points has no area, left out", what, points.size()));
    } else if (std::abs(geo::area(region) - std::abs(geo::signed_area(ring))) >
               // Half a unit of the 0.1 mm rounding all along the ring, twice over.
               1e-4 * geo::length(std::span<const Vec2>(ring))) {
      warn(fmt::format("{} of {} points crosses itself, repaired", what, points.size()));
    }
    return region;
  }

  Region area_of(const RawPolygon& polygon) {
    Region region = inside_of(polygon.outer, "ring");
    for (const auto& hole : polygon.holes)
      region = geo::subtract(region, inside_of(hole, "hole"));
    return region;
  }

  Region enclosed_by(const std::vector<std::vector<Vec2>>& lines) {
    Region rings;
    for (const auto& line : joined_lines(lines)) {
      const double gap = (line.back() - line.front()).norm();
      if (gap > kJoin)
        warn(
            fmt::format("open line of {} points closed over {:.0f} m", line.size(), gap));
      append(rings, inside_of(line, "line"));
    }
    return geo::clean(rings, FillRule::kEvenOdd);
  }

  const std::string& place_;
  const RepairOptions& options_;
  std::vector<std::string>& warnings_;
};

// One perimeter of the series under repair.
struct Entry {
  double time;
  std::string place;
  Region region;
};

// Share of a's area that is missing from b.
double missing_share(const Region& a, const Region& b) {
  return geo::area(geo::subtract(a, b)) / geo::area(a);
}

// The index of an outlier, and why; none when the series is good or cannot be judged.
struct Verdict {
  std::size_t index;
  std::string text;
};
std::optional<Verdict> find_outlier(const std::vector<Entry>& series, double allowed) {
  for (std::size_t k = 0; k + 2 < series.size(); ++k) {
    const Region& a = series[k].region;
    const Region& b = series[k + 1].region;
    const Region& c = series[k + 2].region;
    const double lost = missing_share(a, b);
    if (lost <= allowed) continue;
    const double lost_later = missing_share(a, c);
    if (lost_later > allowed)
      return Verdict{k,
                     fmt::format("{:.0f} % and {:.0f} % of its area are missing from the "
                                 "next two perimeters",
                                 100 * lost, 100 * lost_later)};
    const double odd = missing_share(b, c);
    if (odd > allowed)
      return Verdict{k + 1,
                     fmt::format("{:.0f} % of the one before are missing from it and "
                                 "{:.0f} % of it are missing from the next one",
                                 100 * lost, 100 * odd)};
  }
  return std::nullopt;
}

Result<std::vector<Entry>> sorted_entries(std::vector<RawPerimeter> raw,
                                          const RepairOptions& options,
                                          const std::string& place,
                                          std::vector<std::string>& warnings) {
  const auto earlier = [](const RawPerimeter& a, const RawPerimeter& b) {
    return a.time < b.time;
  };
  if (!std::is_sorted(raw.begin(), raw.end(), earlier)) {
    warnings.push_back(place + ": perimeters were not in order of time, sorted");
    std::stable_sort(raw.begin(), raw.end(), earlier);
  }
  std::vector<Entry> entries;
  std::set<int> skip(options.skip.begin(), options.skip.end());
  int number = -1;
  for (std::size_t i = 0; i < raw.size();) {
    // Features of one time are parts of one perimeter.
    Entry entry{raw[i].time, raw[i].place, {}};
    ++number;
    const bool skipped = skip.erase(number) > 0;
    for (; i < raw.size() && raw[i].time == entry.time; ++i) {
      if (skipped) continue;
      append(entry.region, repaired(raw[i], options, warnings));
    }
    if (skipped) continue;
    entry.region = geo::clean(entry.region, FillRule::kPositive);
    if (entry.region.empty()) {
      warnings.push_back(entry.place + ": encloses nothing, left out");
      continue;
    }
    entries.push_back(std::move(entry));
  }
  if (!skip.empty())
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("has no perimeter number {} to skip", *skip.begin()),
                 fmt::format("0 to {} are allowed", number)};
  return entries;
}

}  // namespace

Result<RawPerimeter> projected(const RawPerimeter& degrees,
                               const geo::LocalFrame& frame) {
  RawPerimeter local = degrees;
  double farthest = 0;
  const auto project = [&](std::vector<Vec2>& points) {
    for (Vec2& p : points) {
      const Vec2 q = frame.to_plane(p.x(), p.y());
      // Beyond the horizon the plane folds back: the straight distance decides.
      const geo::Geodetic g{p.x(), p.y(), 0};
      farthest = std::max(farthest, frame.to_local(g).norm());
      p = q;
    }
  };
  for (RawPolygon& polygon : local.polygons) {
    project(polygon.outer);
    for (auto& hole : polygon.holes) project(hole);
  }
  for (auto& line : local.lines) project(line);
  if (!(farthest <= kFarthest))
    return Error{
        ErrorCode::kBadInput, degrees.place,
        fmt::format("lies up to {:.0f} km from the scenario's origin; {:.0f} km are "
                    "allowed",
                    farthest / 1000, kFarthest / 1000),
        "is the origin right?"};
  return local;
}

Region repaired(const RawPerimeter& raw, const RepairOptions& options,
                std::vector<std::string>& warnings) {
  return Repair(raw.place, options, warnings).region(raw);
}

Result<std::vector<Perimeter>> growing_series(std::vector<RawPerimeter> raw,
                                              const RepairOptions& options,
                                              const std::string& place,
                                              double& first_time,
                                              std::vector<std::string>& warnings) {
  auto sorted = sorted_entries(std::move(raw), options, place, warnings);
  if (!sorted) return sorted.error();
  std::vector<Entry> series = std::move(sorted).value();
  while (options.outliers != Outliers::kUnite) {
    const auto outlier = find_outlier(series, options.outlier_share);
    if (!outlier) break;
    const std::string& which = series[outlier->index].place;
    if (options.outliers == Outliers::kRefuse)
      return Error{ErrorCode::kBadInput, which, "is an outlier: " + outlier->text,
                   "skip it, or let outliers be dropped or united"};
    warnings.push_back(which + ": left out as an outlier: " + outlier->text);
    series.erase(series.begin() + static_cast<std::ptrdiff_t>(outlier->index));
  }
  if (series.empty())
    return Error{ErrorCode::kBadInput, place, "has no perimeter that encloses anything",
                 ""};

  std::vector<Perimeter> result;
  for (const Entry& entry : series) {
    if (result.empty()) {
      first_time += entry.time;
      result.push_back({0, entry.region});
      continue;
    }
    const Region& before = result.back().region;
    const double lost = geo::area(geo::subtract(before, entry.region));
    // Below a percent it is the usual scatter of mapping.
    if (lost > 0.01 * geo::area(before))
      warnings.push_back(
          fmt::format("{}: {:.1f} ha burnt before are missing from it, united",
                      entry.place, lost / 1e4));
    result.push_back(
        {entry.time - series.front().time, geo::unite(before, entry.region)});
  }
  return result;
}

}  // namespace skein::environment
