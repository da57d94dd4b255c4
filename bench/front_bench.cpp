// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>

#include "skein/base/random.h"
#include "skein/layer/environment/fire/front_fire.h"
#include "skein/layer/environment/fire/thesis_fire.h"

namespace skein::environment {
namespace {

// A grid that is sampled bilinearly, as rasters of real terrain are.
class GridTerrain : public Terrain {
 public:
  GridTerrain() {
    for (int x = 0; x < kCells; ++x)
      for (int y = 0; y < kCells; ++y)
        heights_.push_back(80 * std::sin(x * kCell / 500) * std::cos(y * kCell / 350));
  }
  double elevation_msl(const Vec2& p) const override { return sample(p)[0]; }
  Vec2 gradient(const Vec2& p) const override {
    const auto [h, dx, dy] = sample(p);
    return {dx, dy};
  }

 private:
  static constexpr int kCells = 1500;
  static constexpr double kCell = 20;

  std::array<double, 3> sample(const Vec2& p) const {
    const double x = std::clamp(p.x() / kCell + kCells / 2.0, 0.0, kCells - 1.001);
    const double y = std::clamp(p.y() / kCell + kCells / 2.0, 0.0, kCells - 1.001);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const double u = x - i, v = y - j;
    const int index = i * kCells + j;
    const double* h = &heights_[static_cast<std::size_t>(index)];
    const double h00 = h[0], h01 = h[1], h10 = h[kCells], h11 = h[kCells + 1];
    return {(1 - u) * ((1 - v) * h00 + v * h01) + u * ((1 - v) * h10 + v * h11),
            ((1 - v) * (h10 - h00) + v * (h11 - h01)) / kCell,
            ((1 - u) * (h01 - h00) + u * (h11 - h10)) / kCell};
  }
  std::vector<double> heights_;
};

// Wind that turns with place and time.
class TurningWind : public WindField {
 public:
  Vec3 wind(const Vec3& p, Time time) const override {
    const double swing = 0.3 * std::sin(p.x() / 3000 + time.seconds() / 900);
    return {5, 5 * swing, 0};
  }
};

const GridTerrain& terrain() {
  static const GridTerrain t;
  return t;
}

// Fires with wind, slope and fuel patches, at 10 m between markers, whose rate makes them
// grow in one simulated hour to the area named by the argument.
void one_hour(benchmark::State& state, double rate, bool asked) {
  FrontFireOptions options;
  options.spread.rate = rate;
  const TurningWind wind;
  const auto fuel = std::make_shared<PatchyFuel>(PatchyFuelOptions{150, 0.35, 0.02}, 7);
  double hectares = 0, markers = 0, merges = 0;
  for (auto _ : state) {
    FrontFire fire(options, terrain(), wind, fuel);
    RandomStream random(1, 0, Purpose::kTest);
    int inside = 0;
    if (asked) {
      // Four aircraft read at 1 Hz, on a clock of 20 Hz.
      for (int k = 1; k <= 20 * 3600; ++k) {
        fire.advance(Time::from_seconds(0.05 * k));
        if (k % 20 == 0)
          for (int i = 0; i < 4; ++i) {
            const double north = random.uniform(-2000, 4000);
            inside += fire.inside({north, random.uniform(-2000, 2000)});
          }
      }
    } else {
      fire.advance(Time::from_seconds(3600));
    }
    benchmark::DoNotOptimize(inside);
    hectares = geo::area(fire.region()) / 1e4;
    markers = fire.front().markers();
    merges = fire.front().merges();
  }
  state.counters["ha"] = hectares;
  state.counters["markers"] = markers;
  state.counters["merges"] = merges;
  state.counters["cpu_s_per_h"] =
      benchmark::Counter(static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(one_hour, 150_ha, 0.131, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_hour, 4200_ha, 0.735, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_hour, 150_ha_watched, 0.131, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_hour, 4200_ha_watched, 0.735, true)->Unit(benchmark::kMillisecond);

// One in/out question to a fire of 6,000 markers that stands still meanwhile.
void inside(benchmark::State& state) {
  FrontFireOptions options;
  options.spread.rate = 0.735;
  options.age = 3600;
  const TurningWind wind;
  const FrontFire fire(options, terrain(), wind, nullptr);
  RandomStream random(1, 0, Purpose::kTest);
  std::vector<Vec2> points;
  for (int i = 0; i < 4096; ++i) {
    const double north = random.uniform(-2000, 10000);
    points.emplace_back(north, random.uniform(-4000, 4000));
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(fire.inside(points[i++ % points.size()]));
}
BENCHMARK(inside);

void thesis_hour(benchmark::State& state) {
  ThesisFireOptions options;
  options.wind = {0.7, 0.7};
  for (auto _ : state) {
    ThesisFire fire(options, 1, terrain());
    fire.advance(Time::from_seconds(3600));
    benchmark::DoNotOptimize(fire.region().data());
  }
}
BENCHMARK(thesis_hour)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace skein::environment
