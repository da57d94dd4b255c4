#include "skein/layer/reasoning/task/survey/survey_lines.h"

#include <algorithm>
#include <utility>

#include "skein/layer/reasoning/trajectory/round_trip.h"

namespace skein::reasoning {
namespace {

constexpr double kLook = 5;      // between places of a line that are looked at [m]
constexpr double kShortest = 1;  // shorter parts of lines are none [m]

double length_of(const SurveyLine& line) {
  return (line.end - line.begin).norm();
}

bool forbidden(const Vec2& p, std::span<const Zone> zones, double margin) {
  return std::any_of(zones.begin(), zones.end(), [&](const Zone& zone) {
    return covers(zone, p) || distance_between(p, p, outline(zone)) < margin;
  });
}

// Divides a line where it enters and leaves zones.
void divide(const SurveyLine& line, std::span<const Zone> zones, double margin,
            std::vector<SurveyLine>& free, std::vector<SurveyLine>& blocked) {
  const Vec2 along = line.end - line.begin;
  const int looks = std::max(1, static_cast<int>(along.norm() / kLook));
  const auto at = [&](int k) { return Vec2(line.begin + along * (double(k) / looks)); };
  int from = 0;
  bool inside = forbidden(line.begin, zones, margin);
  for (int k = 1; k <= looks; ++k) {
    const bool now = forbidden(at(k), zones, margin);
    if (now == inside && k < looks) continue;
    const SurveyLine part{at(from), at(k), line.missed};
    if (length_of(part) >= kShortest) (inside ? blocked : free).push_back(part);
    from = k;
    inside = now;
  }
}

}  // namespace

SurveyLines::SurveyLines(std::span<const Vec2> ends) {
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    const SurveyLine line{ends[k], ends[k + 1], 0};
    if (length_of(line) < kShortest) continue;
    left_.push_back(line);
    length_ += length_of(line);
  }
}

double SurveyLines::length_left() const {
  double sum = 0;
  for (const SurveyLine& line : left_) sum += length_of(line);
  return sum;
}

double SurveyLines::length_forbidden() const {
  double sum = 0;
  for (const SurveyLine& line : forbidden_) sum += length_of(line);
  return sum;
}

void SurveyLines::regard(std::span<const Zone> zones, double margin) {
  std::vector<SurveyLine> all = std::exchange(left_, {});
  all.insert(all.end(), forbidden_.begin(), forbidden_.end());
  forbidden_.clear();
  for (const SurveyLine& line : all) {
    if (zones.empty())
      left_.push_back(line);
    else
      divide(line, zones, margin, left_, forbidden_);
  }
}

void SurveyLines::flown() {
  if (!left_.empty()) left_.erase(left_.begin());
}

void SurveyLines::missed() {
  if (left_.empty()) return;
  SurveyLine line = left_.front();
  left_.erase(left_.begin());
  if (line.missed++ == 0) left_.push_back(line);
}

void SurveyLines::flown_to(const Vec2& place) {
  if (left_.empty()) return;
  SurveyLine& line = left_.front();
  const double length = length_of(line);
  const Vec2 along = (line.end - line.begin) / length;
  const double done = std::clamp((place - line.begin).dot(along), 0.0, length);
  line.begin += done * along;
  if (length - done < kShortest) flown();
}

}  // namespace skein::reasoning
