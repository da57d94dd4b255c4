// SPDX-License-Identifier: Apache-2.0
// How closely aircraft with six degrees of freedom follow climbs of plans: with climb
// rates that jump, and with vertical turns (model/path/climb_profile.h). The same
// flights, winds and heights are drawn for both. Prints the height over the plan as the
// autopilot believes it, so that errors of navigation are not counted.
//
//   climb_following [FLIGHTS [FIRST]]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "skein/assemble/test/whole_flight.h"
#include "skein/base/random.h"
#include "skein/exchange/table/formats.h"
#include "skein/model/connection/airplane.h"
#include "skein/model/path/flight_plan.h"

namespace {

using namespace skein;

constexpr double kOrder = 20, kEnd = 240;  // of the order and the run [s]
constexpr double kAcceleration = 1;        // of vertical turns [m/s^2]

struct Airframe {
  const char* name;
  const char* plant;
  double airspeed, turn_radius;  // [m/s], [m]
};
constexpr Airframe kAirframes[] = {
    {"bixler", "{kind: fixed-wing, aircraft: bixler}", 15, 60},
    {"aerosonde", "{kind: fixed-wing, aircraft: aerosonde}", 25, 200},
    {"quadrotor", "multirotor", 8, 40}};

// A climb or descent of 20 m and more at 1 to 1.8 m/s on the way to a place ahead.
struct Climb {
  std::uint32_t seed;
  double wind_speed, wind_from_deg;  // [m/s]
  double height, rate;               // up positive [m], [m/s]
  double bearing;                    // to the goal, from north [rad]
};

Climb drawn(std::uint32_t number) {
  RandomStream random(number, 0, Purpose::kTest);
  Climb c;
  c.seed = number;
  c.wind_speed = random.uniform(0, 5);
  c.wind_from_deg = random.uniform(0, 360);
  c.height = random.uniform(20, 40) * (random.uniform() < 0.5 ? -1 : 1);
  c.rate = random.uniform(1, 1.8);
  c.bearing = random.uniform(-1, 1);
  return c;
}

FlightPlan planned(const Climb& c, const Airframe& a, double acceleration) {
  const Vec2 wind = -c.wind_speed * geo::unit(geo::radians(c.wind_from_deg));
  const double length = std::abs(c.height) / c.rate * a.airspeed;
  const Vec2 goal = length * geo::unit(c.bearing);
  const FlightState from{{0, 0, -100}, 0};
  const FlightState to{{goal.x(), goal.y(), -100 - c.height}, c.bearing};
  return model::connect(from, to, {a.airspeed, a.turn_radius, wind},
                        {c.rate, c.rate, acceleration})
      .plan;
}

using Rows = std::vector<assemble::FlightRow>;

// How far from the plan at its times, if it was begun at `begin`.
template <class Take>
void for_each_moment(const Rows& rows, const FlightPlan& plan, double begin,
                     const Take& take) {
  for (const assemble::FlightRow& row : rows) {
    const double t = row.nav.time.seconds() - begin;
    if (t >= 0 && t <= model::end_time_of(plan))
      take(Vec3(row.nav.p_N - model::moment_at(plan, t).p_N));
  }
}

// When the plan was begun: the time with which the flight is nearest to it over ground.
double begin_of(const Rows& rows, const FlightPlan& plan) {
  const Vec2 start = geo::horizontal(plan.front().p_N);
  double begin = 0, nearest = 1e9;
  for (const assemble::FlightRow& row : rows) {
    const double away = (geo::horizontal(row.nav.p_N) - start).norm();
    if (row.nav.time.seconds() <= kOrder || away >= nearest) continue;
    nearest = away;
    begin = row.nav.time.seconds();
  }
  double best = begin, least = 1e9;
  for (double t = begin - 1; t <= begin + 1; t += 0.01) {
    double squares = 0;
    int count = 0;
    for_each_moment(rows, plan, t, [&](const Vec3& off) {
      squares += geo::horizontal(off).squaredNorm();
      ++count;
    });
    if (squares / count >= least) continue;
    least = squares / count;
    best = t;
  }
  return best;
}

struct Tally {
  int flights = 0, missed = 0;
  std::int64_t samples = 0;
  double squares = 0, worst = 0;

  double rms() const { return std::sqrt(squares / static_cast<double>(samples)); }
};

void fly(const Climb& c, const Airframe& a, const FlightPlan& plan, Tally& tally) {
  const auto file = std::filesystem::temp_directory_path() / "climb_following.geojson";
  exchange::Document document;
  document.plans = {{"climb", "", plan}};
  document.frame = geo::LocalFrame::at({37, -122, 0}).value();
  document.has_altitude = true;
  std::ofstream(file)
      << exchange::to_text(document, exchange::Format::kGeojson, {}).value();
  const assemble::FlightLog log = assemble::fly(fmt::format(
      R"(
seed: {}
duration_s: {}
origin: {{latitude_deg: 37, longitude_deg: -122}}
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: {}, from_deg: {}}}
missions: []
aircraft:
  - name: a
    plant: {}
    autopilot: skein
    sensors: [flight]
    altitude_agl_m: 100
    start: {{placement: list, positions_m: [[-400, 0]], heading_deg: 0}}
commands:
  - {{at_s: {}, do: "task a-1 plan file {}"}}
)",
      c.seed, kEnd, c.wind_speed, c.wind_from_deg, a.plant, kOrder, file.string()));
  ++tally.flights;
  if (log.find(EventKind::kTaskDone) == nullptr) {
    ++tally.missed;
    return;
  }
  const Rows& rows = log.rows.at(1);
  for_each_moment(rows, plan, begin_of(rows, plan), [&](const Vec3& off) {
    tally.squares += off.z() * off.z();
    tally.worst = std::max(tally.worst, std::abs(off.z()));
    ++tally.samples;
  });
}

}  // namespace

int main(int argc, char** argv) {
  const int flights = argc > 1 ? std::atoi(argv[1]) : 20;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  fmt::print("{:<12}{:<16}{:>8}{:>8}{:>12}{:>12}\n", "airframe", "climbs begin",
             "flights", "missed", "RMS [m]", "worst [m]");
  for (const Airframe& a : kAirframes)
    for (const double acceleration : {0.0, kAcceleration}) {
      Tally tally;
      for (int k = 0; k < flights; ++k) {
        const Climb c = drawn(static_cast<std::uint32_t>(first + k));
        fly(c, a, planned(c, a, acceleration), tally);
      }
      fmt::print("{:<12}{:<16}{:>8}{:>8}{:>12.2f}{:>12.2f}\n", a.name,
                 acceleration == 0 ? "at once" : "by turns", tally.flights, tally.missed,
                 tally.rms(), tally.worst);
    }
  return 0;
}
