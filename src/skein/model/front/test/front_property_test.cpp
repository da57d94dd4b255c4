// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>

#include "skein/base/random.h"
#include "skein/geo/clip.h"
#include "skein/model/front/front.h"

namespace skein::model::front_property_test {
namespace {

// A random field: patches, gusts, slopes and rocks, all drawn from one seed.
class RandomField : public WaveletField {
 public:
  explicit RandomField(std::uint64_t seed) {
    RandomStream random(seed, 0, Purpose::kTest);
    for (double& v : values_) v = random.uniform(-1, 1);
  }
  void wavelets(std::span<const Vec2> points, double time,
                std::span<Wavelet> out) const override {
    const auto& v = values_;
    const SpreadLaw law{0.3 * std::abs(v[0]), 0.5, 0.3 + 0.2 * v[1], geo::radians(12)};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2& p = points[i];
      const double wave = std::sin(p.x() / (40 + 20 * v[2]) + 3 * v[3]) *
                          std::sin(p.y() / (50 + 20 * v[4]) + 3 * v[5]);
      const double fuel = wave < -0.9 + 0.2 * v[6] ? 0 : std::exp(v[7] * wave);
      const Vec2 wind = 8 * v[8] * geo::unit(v[9] * (3 + time / 600));
      out[i] = spread_wavelet(law, wind, {0.4 * v[10] * wave, 0.3 * v[11]}, fuel);
    }
  }

 private:
  std::array<double, 12> values_{};
};

TEST(FrontProperty, GrowsCleanlyInRandomFieldsFromRandomIgnitions) {
  const bool held =
      rc::check("fronts stay finite, free of crossings, and never shrink", [] {
        const auto seed = static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30));
        const int ignitions = *rc::gen::inRange(1, 6);
        RandomStream random(seed, 1, Purpose::kTest);
        geo::Region start;
        for (int k = 0; k < ignitions; ++k) {
          const double north = random.uniform(-250, 250),
                       east = random.uniform(-250, 250);
          const double radius = random.uniform(3, 40);
          geo::Ring ring;
          for (int i = 0; i < 30; ++i)
            ring.push_back(Vec2(north, east) + radius * geo::unit(2 * geo::kPi * i / 30));
          start.push_back(ring);
        }
        FrontOptions options;
        options.spacing = random.uniform(5, 20);
        const RandomField field(seed);
        Front front(start, options);
        CrossingSearch search;
        geo::Region before = front.region();
        for (int k = 1; k <= 4; ++k) {
          front.advance(field, 150.0 * k);
          for (const geo::Ring& ring : front.region())
            for (const Vec2& p : ring) RC_ASSERT(p.allFinite());
          RC_ASSERT(!search.any(front.region(), 2 * front.spacing()));
          // Markers that are removed or cut off take some corners of a spacing's size
          // with them.
          const double lost = geo::area(geo::subtract(before, front.region()));
          RC_ASSERT(lost <=
                    0.01 * geo::area(before) + 2 * options.spacing * options.spacing);
          before = front.region();
        }
      });
  EXPECT_TRUE(held);
}

}  // namespace
}  // namespace skein::model::front_property_test
