// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/unit_words.h"

#include <array>
#include <cctype>
#include <span>
#include <string>

namespace skein::geo {
namespace {

constexpr double kFootLength = 0.3048, kSurveyFoot = 1200.0 / 3937,
                 kMileLength = 1609.344, kNauticalMileLength = 1852;

struct UnitWord {
  std::string_view word;  // as bare() leaves it
  double in_si;
};

constexpr auto kLengths = std::to_array<UnitWord>({
    {"m", 1},
    {"meter", 1},
    {"meters", 1},
    {"metre", 1},
    {"metres", 1},
    {"gpm", 1},  // of geopotential
    {"dm", 0.1},
    {"decimetre", 0.1},
    {"decimetres", 0.1},
    {"decimeter", 0.1},
    {"decimeters", 0.1},
    {"cm", 0.01},
    {"centimetre", 0.01},
    {"centimetres", 0.01},
    {"centimeter", 0.01},
    {"centimeters", 0.01},
    {"mm", 0.001},
    {"millimetre", 0.001},
    {"millimeter", 0.001},
    {"millimetres", 0.001},
    {"millimeters", 0.001},
    {"km", 1000},
    {"kilometre", 1000},
    {"kilometres", 1000},
    {"kilometer", 1000},
    {"kilometers", 1000},
    {"ft", kFootLength},
    {"foot", kFootLength},
    {"feet", kFootLength},
    {"internationalfoot", kFootLength},
    {"internationalfeet", kFootLength},
    {"footinternational", kFootLength},
    {"footintl", kFootLength},
    {"ussurveyfoot", kSurveyFoot},
    {"ussurveyfeet", kSurveyFoot},
    {"footus", kSurveyFoot},
    {"footussurvey", kSurveyFoot},
    {"surveyfoot", kSurveyFoot},
    {"surveyfeet", kSurveyFoot},
    {"usfoot", kSurveyFoot},
    {"usfeet", kSurveyFoot},
    {"usft", kSurveyFoot},
    {"ftus", kSurveyFoot},
    {"sft", kSurveyFoot},
    {"mi", kMileLength},
    {"mile", kMileLength},
    {"miles", kMileLength},
    {"statutemile", kMileLength},
    {"statutemiles", kMileLength},
    {"nmi", kNauticalMileLength},
    {"nauticalmile", kNauticalMileLength},
    {"nauticalmiles", kNauticalMileLength},
    {"yd", 3 * kFootLength},
    {"yard", 3 * kFootLength},
    {"yards", 3 * kFootLength},
    {"fathom", 6 * kFootLength},
    {"fathoms", 6 * kFootLength},
});

constexpr auto kTimes = std::to_array<UnitWord>({
    {"s", 1},
    {"sec", 1},
    {"secs", 1},
    {"second", 1},
    {"seconds", 1},
    {"ms", 0.001},
    {"msec", 0.001},
    {"millisecond", 0.001},
    {"min", 60},
    {"mins", 60},
    {"minute", 60},
    {"minutes", 60},
    {"h", 3600},
    {"hr", 3600},
    {"hrs", 3600},
    {"hour", 3600},
    {"d", 86400},
    {"hours", 3600},
    {"day", 86400},
    {"days", 86400},
    {"milliseconds", 0.001},
});

constexpr auto kSpeeds = std::to_array<UnitWord>({
    {"mps", 1},
    {"kt", kNauticalMileLength / 3600},
    {"kts", kNauticalMileLength / 3600},
    {"kn", kNauticalMileLength / 3600},
    {"knot", kNauticalMileLength / 3600},
    {"knots", kNauticalMileLength / 3600},
    {"mph", kMileLength / 3600},
    {"kmh", 1000.0 / 3600},
    {"kph", 1000.0 / 3600},
    {"kmph", 1000.0 / 3600},
    {"fps", kFootLength},
});

std::optional<double> found(std::span<const UnitWord> words, std::string_view word) {
  for (const UnitWord& each : words)
    if (each.word == word) return each.in_si;
  return std::nullopt;
}

// Small letters, digits, '/' and '-' before a digit; nothing else says more.
std::string bare(std::string_view text) {
  std::string word;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool minus = c == '-' && i + 1 < text.size() &&
                       std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0;
    if (std::isalnum(c) != 0 || c == '/' || minus)
      word += static_cast<char>(std::tolower(c));
  }
  return word;
}

std::optional<double> per(std::string_view length, std::string_view time) {
  const auto above = found(kLengths, length);
  const auto below = found(kTimes, time);
  if (!above || !below) return std::nullopt;
  return *above / *below;
}

}  // namespace

std::optional<double> length_unit(std::string_view word) {
  return found(kLengths, bare(word));
}

std::optional<double> time_unit(std::string_view word) {
  return found(kTimes, bare(word));
}

std::optional<double> speed_unit(std::string_view text) {
  const std::string word = bare(text);
  if (const auto known = found(kSpeeds, word)) return known;
  const std::string_view whole = word;
  if (const std::size_t slash = whole.find('/'); slash != std::string_view::npos)
    return per(whole.substr(0, slash), whole.substr(slash + 1));
  if (const std::size_t at = whole.find("per"); at != std::string_view::npos)
    return per(whole.substr(0, at), whole.substr(at + 3));
  if (!whole.ends_with("-1")) return std::nullopt;
  const std::string_view both = whole.substr(0, whole.size() - 2);
  for (std::size_t i = 1; i < both.size(); ++i)
    if (const auto speed = per(both.substr(0, i), both.substr(i))) return speed;
  return std::nullopt;
}

}  // namespace skein::geo
