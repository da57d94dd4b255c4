// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/reinitialise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "skein/model/levelset/four.h"

namespace skein::model {
namespace {

constexpr float kFar = std::numeric_limits<float>::max();
constexpr std::uint32_t kAllFixed = 0x01010101;  // of four nodes

struct Point {
  float x, y;
};

// Distance, in cells, from `p` to the piece from `a` to `b`.
float piece_distance(const Point& p, const Point& a, const Point& b) {
  const float dx = b.x - a.x, dy = b.y - a.y;
  const float length2 = dx * dx + dy * dy;
  float t = 0;
  if (length2 > 0)
    t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0F, 1.0F);
  const float ex = p.x - (a.x + t * dx), ey = p.y - (a.y + t * dy);
  return std::sqrt(ex * ex + ey * ey);
}

// Works in units of cells.
class Distance {
 public:
  explicit Distance(const Field& phi)
      : phi_(phi), distance_(phi.values.size(), kFar), fixed_(phi.values.size(), 0) {}

  bool from_contour() {
    bool found = false;
    for (int row = 0; row + 1 < phi_.grid.rows; ++row)
      for (int column = 0; column + 1 < phi_.grid.columns;) {
        const int next = column + static_cast<int>(kLanes);
        if (next < phi_.grid.columns && are_whole(row, column)) {
          column = next;
          continue;
        }
        found = cut_square(row, column) || found;
        ++column;
      }
    return found;
  }

  void sweep() {
    for (int order = 0; order < 4; ++order) {
      const bool up = (order & 1) == 0, right = (order & 2) == 0;
      for (int k = 0; k < phi_.grid.rows; ++k)
        sweep_row(up ? k : phi_.grid.rows - 1 - k, right);
    }
  }

  void write(Field& phi) const {
    const auto cell = static_cast<float>(phi.grid.cell);
    const float* distance = distance_.data();
    float* value = phi.values.data();
    const auto write_one = [&]<class V>(std::size_t i) {
      store<V>(value + i,
               with_sign_of(V(load<V>(distance + i) * cell), load<V>(value + i)));
    };
    std::size_t i = 0;
    for (; i + kLanes <= distance_.size(); i += kLanes)
      write_one.template operator()<Four>(i);
    for (; i < distance_.size(); ++i) write_one.template operator()<float>(i);
  }

 private:
  static bool inside(float value) { return std::signbit(value); }

  // Whether none of the squares at four columns from this one on is cut: all corners of
  // each have the same sign.
  bool are_whole(int row, int column) const {
    const float* south = phi_.values.data() + phi_.grid.index(row, column);
    const float* north = south + phi_.grid.columns;
    const auto signs = [](const float* from) {
      return std::bit_cast<FourBits>(load<Four>(from));
    };
    const FourBits one = signs(south);
    const FourBits differ =
        (one ^ signs(south + 1)) | (one ^ signs(north)) | (one ^ signs(north + 1));
    return !any(differ < 0);
  }

  bool cut_square(int row, int column) {
    const std::array<std::size_t, 4> node{
        phi_.grid.index(row, column), phi_.grid.index(row + 1, column),
        phi_.grid.index(row + 1, column + 1), phi_.grid.index(row, column + 1)};
    std::array<float, 4> v{};
    int count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      v[k] = phi_.values[node[k]];
      count += inside(v[k]) ? 1 : 0;
    }
    if (count == 0 || count == 4) return false;

    constexpr std::array<Point, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    // Where the contour cuts the four sides, in order around the square.
    std::array<Point, 4> cut{};
    std::size_t cuts = 0;
    bool from_inside = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t n = (k + 1) % 4;
      if (inside(v[k]) == inside(v[n])) continue;
      const float difference = v[k] - v[n];
      const float t = difference != 0 ? v[k] / difference : 0.5F;
      cut[cuts] = {kCorner[k].x + t * (kCorner[n].x - kCorner[k].x),
                   kCorner[k].y + t * (kCorner[n].y - kCorner[k].y)};
      if (cuts == 0) from_inside = inside(v[k]);
      ++cuts;
    }
    if (cuts == 2) {
      add_piece(node, kCorner, cut[0], cut[1]);
      return true;
    }
    // A saddle: the bilinear value in its middle says which corners are joined. The first
    // two cuts surround corner 1; joined are the inside ones when the middle is inside.
    const float middle = v[0] * v[2] - v[1] * v[3];
    const float bend = v[0] + v[2] - v[1] - v[3];
    const bool middle_inside = middle / bend < 0;
    const bool first_corner_alone = from_inside == middle_inside;
    if (first_corner_alone) {
      add_piece(node, kCorner, cut[0], cut[1]);
      add_piece(node, kCorner, cut[2], cut[3]);
    } else {
      add_piece(node, kCorner, cut[1], cut[2]);
      add_piece(node, kCorner, cut[3], cut[0]);
    }
    return true;
  }

  void add_piece(const std::array<std::size_t, 4>& node,
                 const std::array<Point, 4>& corner, const Point& a, const Point& b) {
    for (std::size_t k = 0; k < 4; ++k) {
      float& d = distance_[node[k]];
      d = std::min(d, piece_distance(corner[k], a, b));
      fixed_[node[k]] = 1;
    }
  }

  // The smallest solution of max(d - a, 0)^2 + max(d - b, 0)^2 = 1.
  static float solve(float a, float b) {
    const float difference = std::abs(a - b);
    if (difference >= 1) return std::min(a, b) + 1;
    return 0.5F * (a + b + std::sqrt(2 - difference * difference));
  }
  static Four solve(Four a, Four b) {
    const Four difference = absolute(a - b);
    const Four from_both = 0.5F * (a + b + root(2 - difference * difference));
    return difference >= 1 ? minimum(a, b) + 1 : from_both;
  }

  // A row of the grid and its neighbours.
  struct Row {
    float* d;
    const std::uint8_t* fixed;
    const float *below, *above;
    int columns;
  };

  static void sweep_node(const Row& row, int c) {
    if (row.fixed[c] != 0) return;
    const float west = c > 0 ? row.d[c - 1] : kFar;
    const float east = c + 1 < row.columns ? row.d[c + 1] : kFar;
    const float a = std::min(west, east), b = std::min(row.below[c], row.above[c]);
    if (std::min(a, b) < row.d[c]) row.d[c] = std::min(row.d[c], solve(a, b));
  }

  // Whether a sweep would change one of four nodes, which have neighbours on both sides:
  // the first that changes does so by what its neighbours are now.
  static bool changes(const Row& row, int c) {
    const Four d = load<Four>(row.d + c);
    const Four a = minimum(load<Four>(row.d + c - 1), load<Four>(row.d + c + 1));
    const Four b = minimum(load<Four>(row.below + c), load<Four>(row.above + c));
    std::uint32_t fixed = 0;
    std::memcpy(&fixed, row.fixed + c, sizeof fixed);
    return fixed != kAllFixed && any(solve(a, b) < d);
  }

  void sweep_row(int number, bool right) {
    const int columns = phi_.grid.columns;
    const std::size_t start = phi_.grid.index(number, 0);
    float* d = distance_.data() + start;
    const Row row{d, fixed_.data() + start, number > 0 ? d - columns : d + columns,
                  number + 1 < phi_.grid.rows ? d + columns : d - columns, columns};
    constexpr int kFour = static_cast<int>(kLanes);
    int done = 0;  // nodes, from the side where the sweep begins
    while (done < columns) {
      const int first = right ? done : columns - done - kFour;  // of four
      const bool inner = first >= 1 && first + kFour < columns;
      if (inner && !changes(row, first)) {
        done += kFour;
        continue;
      }
      const int until = std::min(columns, done + (inner ? kFour : 1));
      for (; done < until; ++done) sweep_node(row, right ? done : columns - 1 - done);
    }
  }

  const Field& phi_;
  std::vector<float> distance_;
  std::vector<std::uint8_t> fixed_;
};

}  // namespace

void reinitialise(Field& phi) {
  Distance distance(phi);
  if (!distance.from_contour()) return;
  distance.sweep();
  distance.write(phi);
}

}  // namespace skein::model
