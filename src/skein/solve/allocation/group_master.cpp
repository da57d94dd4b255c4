// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/group_master.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"

namespace skein::solve {
namespace {

constexpr double kTiny = 1e-11;    // reduced values below are none
constexpr double kPivot = 1e-9;    // smaller elements are zero
constexpr double kParting = 1e-8;  // of right-hand sides
constexpr int kInvertEvery = 120;

}  // namespace

GroupMaster::GroupMaster(std::size_t aircraft, std::size_t tasks)
    : aircraft_(aircraft), tasks_(tasks), rows_(aircraft + tasks) {
  basis_.resize(rows_);
  inverse_.assign(rows_ * rows_, 0);
  right_.resize(rows_);
  price_.assign(rows_, 0);
  for (std::size_t r = 0; r < rows_; ++r) {
    members_.push_back(static_cast<std::uint32_t>(r));
    append({}, 0, static_cast<std::uint32_t>(r));
    basis_[r] = r;
    inverse(r)[r] = 1;
    // Any spread does: multiples of the golden section never meet.
    const double spread = static_cast<double>(r + 1) * 0.6180339887498949;
    right_[r] = 1 + kParting * (1 + spread - std::floor(spread));
  }
  amount_ = right_;
}

std::size_t GroupMaster::add(GroupColumn column) {
  const double utility = column.utility;
  members_.insert(members_.end(), column.members.begin(), column.members.end());
  members_.push_back(static_cast<std::uint32_t>(aircraft_ + column.task));
  append(std::move(column), utility, kNotBasic);
  return columns() - 1;
}

// The column whose rows are the last of `members_`.
void GroupMaster::append(GroupColumn group, double utility, std::uint32_t basic) {
  groups_.push_back(std::move(group));
  utility_.push_back(utility);
  basic_.push_back(basic);
  allowed_.push_back(true);
  first_.push_back(members_.size());
}

double GroupMaster::amount(std::size_t j) const {
  return basic_[j] == kNotBasic ? 0 : amount_[basic_[j]];
}

double GroupMaster::value() const {
  double value = 0;
  for (std::size_t r = 0; r < rows_; ++r) value += utility_[basis_[r]] * amount_[r];
  return value;
}

void GroupMaster::find_prices() {
  std::fill(price_.begin(), price_.end(), 0.0);
  for (std::size_t r = 0; r < rows_; ++r) {
    const double utility = utility_[basis_[r]];
    if (utility == 0) continue;
    const double* row = inverse(r);
    for (std::size_t k = 0; k < rows_; ++k) price_[k] += utility * row[k];
  }
}

std::size_t GroupMaster::entering() const {
  double most = kTiny;
  std::size_t best = columns();
  for (const std::uint32_t j : may_enter_) {
    if (basic_[j] != kNotBasic) continue;
    double reduced = utility_[j];
    for (const std::uint32_t r : rows_of(j)) reduced -= price_[r];
    if (reduced > most) {
      most = reduced;
      best = j;
    }
  }
  return best;
}

bool GroupMaster::enter(std::size_t j) {
  std::vector<double> direction(rows_, 0.0);
  for (std::size_t r = 0; r < rows_; ++r) {
    const double* row = inverse(r);
    for (const std::uint32_t k : rows_of(j)) direction[r] += row[k];
  }
  std::size_t leaves = rows_;
  double step = 0;
  for (std::size_t r = 0; r < rows_; ++r) {
    if (direction[r] <= kPivot) continue;
    const double ratio = std::max(amount_[r], 0.0) / direction[r];
    if (leaves == rows_ || ratio < step ||
        (ratio == step && direction[r] > direction[leaves])) {
      leaves = r;
      step = ratio;
    }
  }
  if (leaves == rows_) return false;
  basic_[basis_[leaves]] = kNotBasic;
  basic_[j] = static_cast<std::uint32_t>(leaves);
  basis_[leaves] = j;
  double* pivot_row = inverse(leaves);
  for (std::size_t k = 0; k < rows_; ++k) pivot_row[k] /= direction[leaves];
  for (std::size_t r = 0; r < rows_; ++r) {
    if (r == leaves || direction[r] == 0) continue;
    amount_[r] -= step * direction[r];
    double* row = inverse(r);
    for (std::size_t k = 0; k < rows_; ++k) row[k] -= direction[r] * pivot_row[k];
  }
  amount_[leaves] = step;
  if (++since_inverted_ >= kInvertEvery) invert();
  return true;
}

// The inverse anew from the basis, by Gauss and Jordan with row pivots.
void GroupMaster::invert() {
  since_inverted_ = 0;
  std::vector<double> matrix(rows_ * rows_, 0.0);
  std::vector<double> result(rows_ * rows_, 0.0);
  for (std::size_t r = 0; r < rows_; ++r) {
    for (const std::uint32_t k : rows_of(basis_[r])) matrix[k * rows_ + r] = 1;
    result[r * rows_ + r] = 1;
  }
  for (std::size_t c = 0; c < rows_; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < rows_; ++r)
      if (std::abs(matrix[r * rows_ + c]) > std::abs(matrix[pivot * rows_ + c]))
        pivot = r;
    if (std::abs(matrix[pivot * rows_ + c]) < kPivot) return;  // keep the old one
    if (pivot != c)
      for (std::size_t k = 0; k < rows_; ++k) {
        std::swap(matrix[c * rows_ + k], matrix[pivot * rows_ + k]);
        std::swap(result[c * rows_ + k], result[pivot * rows_ + k]);
      }
    const double scale = 1 / matrix[c * rows_ + c];
    for (std::size_t k = 0; k < rows_; ++k) {
      matrix[c * rows_ + k] *= scale;
      result[c * rows_ + k] *= scale;
    }
    for (std::size_t r = 0; r < rows_; ++r) {
      const double factor = matrix[r * rows_ + c];
      if (r == c || factor == 0) continue;
      for (std::size_t k = 0; k < rows_; ++k) {
        matrix[r * rows_ + k] -= factor * matrix[c * rows_ + k];
        result[r * rows_ + k] -= factor * result[c * rows_ + k];
      }
    }
  }
  inverse_ = std::move(result);
  for (std::size_t r = 0; r < rows_; ++r) {
    amount_[r] = 0;
    for (std::size_t k = 0; k < rows_; ++k) amount_[r] += inverse(r)[k] * right_[k];
  }
}

bool GroupMaster::solve(std::int64_t max_steps) {
  may_enter_.clear();
  for (std::uint32_t j = 0; j < columns(); ++j)
    if (allowed_[j]) may_enter_.push_back(j);
  for (std::int64_t step = 0;; ++step) {
    find_prices();
    const std::size_t j = entering();
    if (j == columns()) return true;
    if (step >= max_steps || !enter(j)) return false;
  }
}

}  // namespace skein::solve
