// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/flight_code.h"

#include <array>
#include <cmath>
#include <limits>

#include "skein/base/math.h"
#include "skein/geo/vec.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model {
namespace {

constexpr double kSecond = 1e3;                            // steps of time
constexpr double kMetre = 1e3;                             // of positions
constexpr double kFullTurn = 16777216.0 / (2 * geo::kPi);  // of headings, per radian
constexpr double kTurned = 2e5;                            // of angles turned, per radian
constexpr double kSpeed = 500;                             // of wind and climb
constexpr double kAirspeed = 200;
constexpr std::int64_t kMaxDuration = (1 << 20) - 1;  // [ms]
constexpr std::int64_t kMaxTurned = (1 << 23) - 1;
// What an element is, beside its duration.
constexpr std::int64_t kVerticalTurn = 1 << 23;
constexpr std::int64_t kTurns = 1 << 22;
constexpr std::int64_t kOtherAirspeed = 1 << 21;
constexpr std::int64_t kClimbs = 1 << 20;
// Elements join when they are no further apart.
constexpr double kSamePlace = 0.05;    // [m]
constexpr double kSameHeading = 1e-4;  // [rad]
constexpr double kSameWind = 1e-3;     // [m/s]
constexpr double kSameTime = 2e-3;     // [s]
constexpr std::size_t kJoinedBlock = 6, kPlace = 19;
constexpr std::int64_t kJoins = 1 << 15;  // in the number of a block's elements

std::int64_t steps(double value, double per_unit) {
  const double scaled = std::floor(value * per_unit + 0.5);
  constexpr double kLargest = 9e15;
  return std::abs(scaled) < kLargest ? static_cast<std::int64_t>(scaled)
                                     : std::numeric_limits<std::int64_t>::max();
}

class Writer {
 public:
  void put(std::int64_t value, int bytes, bool is_signed) {
    const int bits = 8 * bytes - (is_signed ? 1 : 0);
    const std::int64_t end = std::int64_t{1} << bits;
    fits_ = fits_ && value < end && value >= (is_signed ? -end : 0);
    for (int k = 0; k < bytes; ++k)
      bytes_.push_back(static_cast<std::uint8_t>(
          static_cast<std::uint64_t>(value) >> (8 * k) & 0xffu));
  }
  std::vector<std::uint8_t> bytes_;
  bool fits_ = true;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool has(std::size_t count) const { return bytes_.size() - at_ >= count; }
  bool at_end() const { return at_ == bytes_.size(); }
  std::int64_t get(int bytes, bool is_signed) {
    std::uint64_t value = 0;
    for (int k = 0; k < bytes; ++k)
      value |= static_cast<std::uint64_t>(bytes_[at_++]) << (8 * k);
    const std::uint64_t sign = std::uint64_t{1} << (8 * bytes - 1);
    if (is_signed && (value & sign) != 0) value -= sign << 1;
    return static_cast<std::int64_t>(value);
  }
  double number(int bytes, bool is_signed, double per_unit) {
    return static_cast<double>(get(bytes, is_signed)) / per_unit;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

// An element as it is coded: what is known of it once it is read.
struct Coded {
  std::int64_t duration = 0, turned = 0, airspeed = 0, climb_rate = 0;
  bool vertical_turn = false;
};

void write(Writer& out, const Coded& c, std::int64_t airspeed_before) {
  const bool other_airspeed = c.airspeed != airspeed_before;
  out.put(c.duration | (c.vertical_turn ? kVerticalTurn : 0) |
              (c.turned != 0 ? kTurns : 0) | (other_airspeed ? kOtherAirspeed : 0) |
              (c.climb_rate != 0 ? kClimbs : 0),
          3, false);
  if (c.turned != 0) out.put(c.turned, 3, true);
  if (other_airspeed) out.put(c.airspeed, 2, false);
  if (c.climb_rate != 0) out.put(c.climb_rate, 2, true);
}

// @returns  nothing where bytes are missing.
std::optional<Coded> read(Reader& in, std::int64_t airspeed_before) {
  if (!in.has(3)) return std::nullopt;
  const std::int64_t first = in.get(3, false);
  const bool turns = (first & kTurns) != 0, climbs = (first & kClimbs) != 0;
  const bool other_airspeed = (first & kOtherAirspeed) != 0;
  if (!in.has((turns ? 3u : 0u) + (other_airspeed ? 2u : 0u) + (climbs ? 2u : 0u)))
    return std::nullopt;
  Coded c;
  c.duration = first & kMaxDuration;
  c.vertical_turn = (first & kVerticalTurn) != 0;
  if (turns) c.turned = in.get(3, true);
  c.airspeed = other_airspeed ? in.get(2, false) : airspeed_before;
  if (climbs) c.climb_rate = in.get(2, true);
  return c;
}

// Shorter parts of an element whose duration or turn does not fit.
std::vector<FlightElement> parts_of(const FlightElement& e) {
  const double longest = static_cast<double>(kMaxDuration - 1) / kSecond;
  const double widest = static_cast<double>(kMaxTurned - 1) / kTurned;
  const double count = std::max(std::ceil(e.duration / longest),
                                std::ceil(std::abs(e.turn_rate) * e.duration / widest));
  if (!(count > 1)) return {e};
  std::vector<FlightElement> parts;
  const int n = static_cast<int>(std::min(count, 65536.0));
  for (int k = 0; k < n; ++k) {
    const double after = e.duration * k / n;
    const FlightMoment m = moment(e, after);
    FlightElement part = e;
    part.start = e.start + after;
    part.duration = e.duration / n;
    part.p_N = m.p_N;
    part.heading = m.heading;
    part.climb_rate = e.climb_rate + e.climb_acceleration * after;
    parts.push_back(part);
  }
  return parts;
}

// The element that the numbers mean, from where the flight is by then.
FlightElement element_of(const Coded& c, std::int64_t next_climb, const FlightState& from,
                         double start, const Vec2& wind) {
  FlightElement e;
  e.start = start;
  e.duration = static_cast<double>(c.duration) / kSecond;
  e.p_N = from.p_N;
  e.heading = from.heading;
  e.airspeed = static_cast<double>(c.airspeed) / kAirspeed;
  e.wind = wind;
  e.climb_rate = static_cast<double>(c.climb_rate) / kSpeed;
  if (c.duration > 0) {
    e.turn_rate = static_cast<double>(c.turned) / kTurned / e.duration;
    if (c.vertical_turn)
      e.climb_acceleration =
          (static_cast<double>(next_climb) / kSpeed - e.climb_rate) / e.duration;
  }
  return e;
}

bool joins(const FlightElement& last, const FlightElement& next) {
  const FlightMoment at = end_of(last);
  return std::abs(last.start + last.duration - next.start) < kSameTime &&
         (at.p_N - next.p_N).norm() < kSamePlace &&
         std::abs(geo::wrap_pi(at.heading - next.heading)) < kSameHeading;
}

bool same_wind(const FlightElement& last, const FlightElement& next) {
  return (last.wind - next.wind).norm() < kSameWind;
}

// What it ends with is not said where its block ends: level.
bool turns_to_climb(const FlightElement& last) {
  const double climb = last.climb_rate + last.climb_acceleration * last.duration;
  return last.climb_acceleration != 0 && steps(climb, kSpeed) != 0;
}

void write_block(Writer& out, std::span<const FlightElement> elements, bool joined) {
  const FlightElement& first = elements.front();
  const auto count = static_cast<std::int64_t>(elements.size());
  out.put(count, 2, true);
  if (joined) out.bytes_.back() |= kJoins >> 8;
  for (int k = 0; k < 2; ++k) out.put(steps(first.wind[k], kSpeed), 2, true);
  if (!joined) {
    out.put(steps(first.start, kSecond), 4, false);
    for (int k = 0; k < 3; ++k) out.put(steps(first.p_N[k], kMetre), 4, true);
    out.put(steps(geo::wrap_pi(first.heading), kFullTurn) & 0xffffff, 3, false);
  }
  // Times and headings are rounded as sums, so that errors do not add up.
  std::int64_t time = steps(first.start, kSecond), heading = 0, airspeed = 0;
  double turned = 0;
  for (const FlightElement& e : elements) {
    const std::int64_t end = steps(e.start + e.duration, kSecond);
    turned += e.turn_rate * e.duration;
    const std::int64_t turned_until = steps(turned, kTurned);
    const Coded coded{std::max<std::int64_t>(0, end - time), turned_until - heading,
                      steps(e.airspeed, kAirspeed), steps(e.climb_rate, kSpeed),
                      e.climb_acceleration != 0};
    write(out, coded, airspeed);
    time += coded.duration;
    heading = turned_until;
    airspeed = coded.airspeed;
  }
}

bool is_finite(const FlightElement& e) {
  return std::isfinite(e.start) && std::isfinite(e.duration) && e.p_N.allFinite() &&
         std::isfinite(e.heading) && std::isfinite(e.airspeed) &&
         std::isfinite(e.turn_rate) && std::isfinite(e.climb_rate) &&
         e.wind.allFinite() && std::isfinite(e.climb_acceleration) && e.duration >= 0;
}

bool read_block(Reader& in, FlightPlan& plan) {
  if (!in.has(kJoinedBlock)) return false;
  const std::int64_t first = in.get(2, false);
  const bool joined = (first & kJoins) != 0;
  const auto count = static_cast<std::size_t>(first & (kJoins - 1));
  Vec2 wind;
  for (int k = 0; k < 2; ++k) wind[k] = in.number(2, true, kSpeed);
  if (count == 0 || (joined ? plan.empty() : !in.has(kPlace))) return false;
  double start = 0;
  FlightState at;
  if (joined) {
    const FlightMoment end = end_of(plan.back());
    at = {end.p_N, end.heading};
    start = end_time_of(plan);
  } else {
    start = in.number(4, false, kSecond);
    for (int k = 0; k < 3; ++k) at.p_N[k] = in.number(4, true, kMetre);
    at.heading = geo::wrap_pi(in.number(3, false, kFullTurn));
  }
  std::vector<Coded> coded;
  for (std::int64_t airspeed = 0; coded.size() < count;) {
    const auto c = read(in, airspeed);
    if (!c) return false;
    airspeed = c->airspeed;
    coded.push_back(*c);
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (coded[k].duration == 0) continue;
    const std::int64_t next = k + 1 < count ? coded[k + 1].climb_rate : 0;
    plan.push_back(element_of(coded[k], next, at, start, wind));
    const FlightMoment end = end_of(plan.back());
    at = {end.p_N, end.heading};
    start += plan.back().duration;
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::uint8_t>> coded_flight(const FlightPlan& plan) {
  if (plan.empty()) return std::nullopt;
  std::vector<FlightElement> all;
  for (const FlightElement& e : plan) {
    if (!is_finite(e)) return std::nullopt;
    const auto parts = parts_of(e);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  Writer out;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && joins(all[end - 1], all[end]) &&
           same_wind(all[end - 1], all[end]))
      ++end;
    // What lasts no millisecond is not there to be joined.
    const bool joined =
        first > 0 && joins(all[first - 1], all[first]) &&
        !turns_to_climb(all[first - 1]) &&
        steps(all[first].start, kSecond) > steps(all.front().start, kSecond);
    write_block(out, std::span(all).subspan(first, end - first), joined);
    first = end;
  }
  if (!out.fits_) return std::nullopt;
  return std::move(out.bytes_);
}

std::optional<FlightPlan> decoded_flight(std::span<const std::uint8_t> bytes) {
  Reader in(bytes);
  FlightPlan plan;
  while (!in.at_end())
    if (!read_block(in, plan)) return std::nullopt;
  for (std::size_t k = 1; k < plan.size(); ++k)
    if (plan[k].start < plan[k - 1].start + plan[k - 1].duration - kSameTime)
      return std::nullopt;
  if (plan.empty()) return std::nullopt;
  return plan;
}

FlightPlan as_sent(FlightPlan plan) {
  if (const auto coded = coded_flight(plan))
    if (auto rounded = decoded_flight(*coded)) return *std::move(rounded);
  return plan;
}

}  // namespace skein::model
