// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/front.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"

namespace skein::model::front_test {
namespace {

using geo::kPi;

class FieldOf : public WaveletField {
 public:
  explicit FieldOf(std::function<Wavelet(const Vec2&, double)> at) : at_(std::move(at)) {}
  void wavelets(std::span<const Vec2> points, double time,
                std::span<Wavelet> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = at_(points[i], time);
  }

 private:
  std::function<Wavelet(const Vec2&, double)> at_;
};

FieldOf uniform(const Wavelet& w) {
  return FieldOf([w](const Vec2&, double) { return w; });
}
FieldOf round(double rate) {
  return uniform({{1, 0}, rate, rate, 0});
}

geo::Ring circle(const Vec2& centre, double radius, int count = 90) {
  geo::Ring ring;
  for (int i = 0; i < count; ++i)
    ring.push_back(centre + radius * geo::unit(2 * kPi * i / count));
  return ring;
}

Vec2 turned(const Vec2& p, double angle) {
  return std::cos(angle) * p + std::sin(angle) * geo::turned_right(p);
}

// A rough field: rates vary by a factor of 7 over some 100 m, with wind.
Wavelet rough(const Vec2& p, double time) {
  const double fuel = 1 + 0.75 * std::sin(p.x() / 40) * std::sin(p.y() / 55 + 1);
  const SpreadLaw law{0.2, 0.5, 0.5, geo::radians(10)};
  const Vec2 slope(0.2 * std::sin(p.y() / 150), 0.2 * std::cos(p.x() / 120));
  return spread_wavelet(law, 4 * geo::unit(0.5 + time / 3600), slope, fuel);
}

TEST(Front, GrowsACircleInAUniformField) {
  Front front({circle({50, 20}, 10)}, {});
  const FieldOf field = round(0.5);
  front.advance(field, 1800);
  EXPECT_EQ(front.time(), 1800);
  ASSERT_EQ(front.region().size(), 1u);
  // Asked for: 1 %. The start polygon lacks 0.08 %, and chords of 14 m at 900 m 0.004 %.
  for (const Vec2& p : front.region()[0])
    EXPECT_NEAR((p - Vec2(50, 20)).norm(), 910, 0.005 * 910);
  EXPECT_NEAR(geo::area(front.region()) / (kPi * 910 * 910), 1, 0.005);
  EXPECT_EQ(front.merges(), 0);
}

TEST(Front, GrowsTheAnalyticEllipseUnderWind) {
  // From a point the front is the wavelet scaled by time; from a circle of 5 m, the same
  // widened by 5 m.
  const Wavelet w{geo::unit(0.4), 0.5, 0.2, 0.45};
  Front front({circle({0, 0}, 5)}, {});
  const FieldOf field = uniform(w);
  front.advance(field, 1800);
  const Vec2 h = geo::unit(0.4), t = geo::turned_right(h);
  double head = -1e9, back = -1e9, flank = -1e9;
  for (const Vec2& p : front.region()[0]) {
    head = std::max(head, p.dot(h));
    back = std::max(back, -p.dot(h));
    flank = std::max(flank, p.dot(t));
  }
  EXPECT_NEAR(head, 0.95 * 1800 + 5, 0.005 * 0.95 * 1800);
  EXPECT_NEAR(flank, 0.2 * 1800 + 5, 0.01 * 0.2 * 1800);
  EXPECT_NEAR(back, 0.05 * 1800 + 5, 5);  // half a spacing
  // Steiner: area of an ellipse widened by d is A + perimeter d + pi d^2.
  const double a = 900, b = 360, d = 5;
  const double perimeter = kPi * (3 * (a + b) - std::sqrt((3 * a + b) * (a + 3 * b)));
  EXPECT_NEAR(geo::area(front.region()) / (kPi * a * b + perimeter * d + kPi * d * d), 1,
              0.01);
}

TEST(Front, DoesNotPreferDirectionsOfTheAxes) {
  double areas[3];
  int k = 0;
  for (double turn : {0.0, 0.3, 1.234}) {
    const FieldOf field([turn](const Vec2& p, double time) {
      Wavelet w = rough(turned(p, -turn), time);
      w.heading = turned(w.heading, turn);
      return w;
    });
    geo::Ring start = circle({0, 0}, 30);
    for (Vec2& p : start) p = turned(p, turn);
    Front front({start}, {});
    front.advance(field, 1200);
    areas[k++] = geo::area(front.region());
  }
  // Only rounding differs, but it may tip a marker's insertion or a cut: a few spacings^2
  // of some 500,000 m^2.
  EXPECT_NEAR(areas[1] / areas[0], 1, 2e-3);
  EXPECT_NEAR(areas[2] / areas[0], 1, 2e-3);
}

TEST(Front, TwoFrontsMergeIntoTheUnionOfTheirCircles) {
  Front front({circle({0, 0}, 20), circle({300, 100}, 20)}, {});
  const FieldOf field = round(0.4);
  front.advance(field, 600);
  const double expected =
      geo::area(geo::unite({circle({0, 0}, 260, 2000)}, {circle({300, 100}, 260, 2000)}));
  EXPECT_EQ(front.region().size(), 1u);
  EXPECT_GE(front.merges(), 1);
  EXPECT_NEAR(geo::area(front.region()) / expected, 1, 0.005);
}

TEST(Front, ARingOfFiresLeavesAnIslandThatBurnsInwards) {
  geo::Region start;
  for (int i = 0; i < 8; ++i) start.push_back(circle(300 * geo::unit(kPi * i / 4), 20));
  Front front(start, {});
  const FieldOf field = round(0.5);
  front.advance(field, 250);  // radius 145: neighbours, 230 m apart, have met
  ASSERT_EQ(front.region().size(), 2u);
  EXPECT_FALSE(geo::contains(front.region(), Vec2(0, 0)));
  geo::Region expected;
  for (int i = 0; i < 8; ++i)
    expected = geo::unite(expected, {circle(300 * geo::unit(kPi * i / 4), 145, 1000)});
  EXPECT_NEAR(geo::area(front.region()) / geo::area(expected), 1, 0.01);
  front.advance(field, 620);  // the centre is reached at 560 s
  EXPECT_EQ(front.region().size(), 1u);
  EXPECT_TRUE(geo::contains(front.region(), Vec2(0, 0)));
}

TEST(Front, FlowsAroundWhatDoesNotBurnAndClosesBehindIt) {
  const Vec2 rock(200, 0);
  const FieldOf field([rock](const Vec2& p, double) {
    const double rate = (p - rock).norm() < 60 ? 0 : 0.5;
    return Wavelet{{1, 0}, rate, rate, 0};
  });
  Front front({circle({0, 0}, 20)}, {});
  front.advance(field, 380);  // radius 210: the front is passing the rock
  EXPECT_FALSE(geo::contains(front.region(), rock));
  EXPECT_FALSE(geo::contains(front.region(), Vec2(255, 0)));
  // Behind the rock lies its shadow: 280 m from the start, but further around the rock.
  front.advance(field, 515);
  EXPECT_TRUE(geo::contains(front.region(), Vec2(0, 270)));
  EXPECT_FALSE(geo::contains(front.region(), Vec2(266, 0)));
  front.advance(field, 900);
  ASSERT_EQ(front.region().size(), 2u);
  EXPECT_FALSE(geo::contains(front.region(), rock));
  EXPECT_TRUE(geo::contains(front.region(), Vec2(300, 0)));
  // The hole is the rock, up to half a spacing along its edge.
  EXPECT_NEAR(-geo::signed_area(front.region()[1]), kPi * 60 * 60, 2 * kPi * 60 * 5);
}

// Arrival times on a square grid by fast sweeping [Zhao05]: |grad T| rate = 1, T = 0
// in the start circle. First order in the cell.
class Arrival {
 public:
  Arrival(double half_side, double cell, double start_radius, const FieldOf& field)
      : n_(static_cast<int>(2 * half_side / cell) + 1), cell_(cell), half_(half_side) {
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) {
        const Vec2 p = centre(i, j);
        Wavelet w;
        field.wavelets({&p, 1}, 0, {&w, 1});
        slowness_.push_back(w.length > 0 ? 1 / w.length : 1e9);
        // Near the circle the distance is the better start than 0.
        const double outside = p.norm() - start_radius;
        time_.push_back(outside < 0           ? 0
                        : outside < 2 * cell_ ? outside * slowness_.back()
                                              : 1e12);
      }
    for (int round = 0; round < 6; ++round)
      for (int order = 0; order < 4; ++order) sweep(order & 1, order & 2);
  }
  int size() const { return n_; }
  std::size_t index(int i, int j) const {
    const int k = i * n_ + j;
    return static_cast<std::size_t>(k);
  }
  Vec2 centre(int i, int j) const { return {i * cell_ - half_, j * cell_ - half_}; }
  double at(int i, int j) const { return time_[index(i, j)]; }

 private:
  double get(int i, int j) const {
    return i < 0 || j < 0 || i >= n_ || j >= n_ ? 1e12 : at(i, j);
  }
  void sweep(bool flip_i, bool flip_j) {
    for (int ii = 0; ii < n_; ++ii)
      for (int jj = 0; jj < n_; ++jj) {
        const int i = flip_i ? n_ - 1 - ii : ii, j = flip_j ? n_ - 1 - jj : jj;
        const auto k = index(i, j);
        const double a = std::min(get(i - 1, j), get(i + 1, j));
        const double b = std::min(get(i, j - 1), get(i, j + 1));
        const double f = cell_ * slowness_[k];
        const double t = std::abs(a - b) >= f
                             ? std::min(a, b) + f
                             : (a + b + std::sqrt(2 * f * f - (a - b) * (a - b))) / 2;
        time_[k] = std::min(time_[k], t);
      }
  }
  int n_;
  double cell_, half_;
  std::vector<double> slowness_, time_;
};

TEST(Front, AgreesWithArrivalTimesOnAGrid) {
  const FieldOf field([](const Vec2& p, double) {
    const double wave = std::sin(p.x() / 37) * std::sin(p.y() / 45 + 1);
    const double rate = wave < -0.8 ? 0 : 0.3 * std::exp(0.9 * wave);  // with rocks
    return Wavelet{{1, 0}, rate, rate, 0};
  });
  const Arrival arrival(500, 1.25, 30, field);
  Front front({circle({0, 0}, 30)}, {});
  for (double time : {300.0, 600.0, 1000.0}) {
    front.advance(field, time);
    const geo::BoundaryIndex index(front.region());
    int both = 0, either = 0;
    for (int i = 0; i < arrival.size(); ++i)
      for (int j = 0; j < arrival.size(); ++j) {
        const bool grid = arrival.at(i, j) <= time;
        const bool line = index.contains(arrival.centre(i, j));
        both += grid && line;
        either += grid || line;
      }
    // The grid's error leads, and is of first order: measured 0.972 with cells of 2.5 m,
    // 0.985 with 1.25 m, hardly dependent on the markers' spacing.
    EXPECT_GT(1.0 * both / either, 0.98) << time;
  }
}

TEST(Front, ConvergesWithSpacing) {
  const FieldOf field(rough);
  std::vector<double> areas;
  for (double spacing : {20.0, 10.0, 5.0, 2.5}) {
    FrontOptions options;
    options.spacing = spacing;
    Front front({circle({0, 0}, 30, 200)}, options);
    front.advance(field, 1200);
    areas.push_back(geo::area(front.region()));
  }
  const double last = areas.back();
  // Measured 0.02 % at 10 m; other compilers may round cuts otherwise.
  EXPECT_LT(std::abs(areas[1] / last - 1), 0.002);
  EXPECT_LT(std::abs(areas[2] / last - 1), 0.002);
  EXPECT_LT(std::abs(areas[2] - last), std::abs(areas[0] - last));
}

TEST(Front, NeverGivesBackWhatHasBurnt) {
  const FieldOf field(rough);
  Front front({circle({0, 0}, 30), circle({250, 200}, 15)}, {});
  geo::Region before = front.region();
  for (int k = 1; k <= 40; ++k) {
    front.advance(field, 45.0 * k);
    for (const geo::Ring& ring : front.region())
      for (const Vec2& p : ring) ASSERT_TRUE(p.allFinite());
    // Removing a marker cuts its corner: up to 2 m^2 of 150,000 were measured.
    const double lost = geo::area(geo::subtract(before, front.region()));
    EXPECT_LT(lost, 10) << "at " << front.time();
    before = front.region();
  }
}

TEST(Front, StaysFreeOfCrossings) {
  const FieldOf field(rough);
  Front front({circle({0, 0}, 30), circle({250, 200}, 15)}, {});
  CrossingSearch search;
  for (int k = 1; k <= 300; ++k) {
    front.step(field);
    ASSERT_FALSE(search.any(front.region(), 20)) << "at " << front.time();
    ASSERT_NEAR(geo::area(geo::clean(front.region(), geo::FillRule::kPositive)),
                geo::area(front.region()), 1.0);
  }
}

TEST(Front, StandsStillAtRateZero) {
  Front front({circle({0, 0}, 50)}, {});
  const geo::Region before = front.region();
  const FieldOf field = round(0);
  front.advance(field, 3600);
  EXPECT_NEAR(geo::area(front.region()), geo::area(before), 1e-6);
}

TEST(Front, NothingBurntStaysNothing) {
  Front front({}, {});
  const FieldOf field = round(1);
  front.advance(field, 100);
  EXPECT_TRUE(front.region().empty());
  front.ignite({circle({0, 0}, 20)});
  front.advance(field, 200);
  EXPECT_NEAR(geo::area(front.region()) / (kPi * 120 * 120), 1, 0.01);
}

TEST(Front, TooManyMarkersMakeItCoarserNotLarger) {
  FrontOptions options;
  options.max_markers = 300;
  Front front({circle({0, 0}, 100)}, options);
  const FieldOf field = round(2);
  front.advance(field, 3600);  // perimeter 45 km
  EXPECT_LE(front.markers(), 300);
  EXPECT_GT(front.spacing(), options.spacing);
  EXPECT_NEAR(geo::area(front.region()) / (kPi * 7300 * 7300), 1, 0.02);
}

TEST(Front, EndsWithTheWorldInsteadOfFailing) {
  FrontOptions options;
  options.spacing = 1e5;
  options.max_step = 3600;
  Front front({circle({0, 0}, 9e6)}, options);
  const FieldOf field = round(1e3);
  front.advance(field, 20000);
  ASSERT_FALSE(front.region().empty());
  for (const geo::Ring& ring : front.region())
    for (const Vec2& p : ring) EXPECT_LE(p.cwiseAbs().maxCoeff(), 1e7 + 1e5);
}

TEST(Front, TakesTheSameStepsWhoeverAsks) {
  const FieldOf field(rough);
  Front one({circle({0, 0}, 30)}, {}), two({circle({0, 0}, 30)}, {});
  for (int k = 0; k < 200; ++k) one.step(field);
  while (two.next_time(field) <= one.time()) two.step(field);
  EXPECT_EQ(one.time(), two.time());
  EXPECT_EQ(one.region(), two.region());
}

TEST(FrontOptions, RefusesImpossibleValues) {
  EXPECT_TRUE(check(FrontOptions{}).ok());
  EXPECT_FALSE(check(FrontOptions{0, 0.25, 10, 1000}).ok());
  EXPECT_FALSE(check(FrontOptions{10, 0.9, 10, 1000}).ok());
  EXPECT_FALSE(check(FrontOptions{10, 0.25, 0, 1000}).ok());
  EXPECT_FALSE(check(FrontOptions{10, 0.25, 10, 1}).ok());
  EXPECT_FALSE(
      check(FrontOptions{std::numeric_limits<double>::quiet_NaN(), 0.25, 10, 1000}).ok());
}

}  // namespace
}  // namespace skein::model::front_test
