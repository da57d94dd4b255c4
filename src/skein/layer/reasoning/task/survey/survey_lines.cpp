// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/survey/survey_lines.h"

#include <algorithm>
#include <utility>

#include "skein/solve/coverage/zone_lines.h"

namespace skein::reasoning {
namespace {

constexpr double kShortest = 1;  // shorter parts of lines are none [m]

double length_of(const SurveyLine& line) {
  return (line.end - line.begin).norm();
}

// Divides a line into what can be flown, ends included, and the rest.
void divide(const SurveyLine& line, const solve::ZoneRings& zones,
            const solve::ZoneRoom& room, std::vector<SurveyLine>& free,
            std::vector<SurveyLine>& blocked) {
  const double length = length_of(line);
  const Vec2 along = (line.end - line.begin) / length;
  std::vector<solve::Span> spans;
  for (const solve::SweepLine& part :
       solve::clear_of({{line.begin, line.end, 0}}, zones, room)) {
    const double a = (part.a - line.begin).dot(along),
                 b = (part.b - line.begin).dot(along);
    spans.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(spans.begin(), spans.end(),
            [](const auto& a, const auto& b) { return a.low < b.low; });
  double done = 0;
  const auto add = [&](double from, double to, std::vector<SurveyLine>& parts) {
    if (to - from >= kShortest)
      parts.push_back({line.begin + from * along, line.begin + to * along, line.missed});
  };
  for (const solve::Span& span : spans) {
    add(done, span.low, blocked);
    add(span.low, span.high, free);
    done = span.high;
  }
  add(done, length, blocked);
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

void SurveyLines::regard(std::span<const Zone> zones, double turn_radius) {
  std::vector<SurveyLine> all = std::exchange(left_, {});
  all.insert(all.end(), forbidden_.begin(), forbidden_.end());
  forbidden_.clear();
  std::vector<geo::Ring> rings;
  for (const Zone& zone : zones) rings.push_back(outline(zone));
  const solve::ZoneRings borders(std::move(rings));
  for (const SurveyLine& line : all) {
    if (zones.empty())
      left_.push_back(line);
    else
      divide(line, borders, {0, turn_radius}, left_, forbidden_);
  }
}

void SurveyLines::flown() {
  if (!left_.empty()) left_.erase(left_.begin());
}

void SurveyLines::missed() {
  if (left_.empty()) return;
  SurveyLine line = left_.front();
  left_.erase(left_.begin());
  if (line.missed++ == 0)
    left_.push_back(line);
  else
    given_up_ += length_of(line);
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
