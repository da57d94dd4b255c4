#include "skein/layer/reasoning/team/allocation/group_master.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"

namespace skein::allocation {
namespace {

constexpr double kTiny = 1e-9;     // reduced values below are none
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
    Column slack;
    slack.rows = {static_cast<std::uint32_t>(r)};
    slack.basic = static_cast<std::uint32_t>(r);
    columns_.push_back(slack);
    basis_[r] = r;
    inverse(r)[r] = 1;
    // Any spread does: multiples of the golden section never meet.
    const double spread = static_cast<double>(r + 1) * 0.6180339887498949;
    right_[r] = 1 + kParting * (1 + spread - std::floor(spread));
  }
  amount_ = right_;
}

std::size_t GroupMaster::add(GroupColumn column) {
  Column added;
  added.utility = column.utility;
  added.rows = column.members;
  added.rows.push_back(static_cast<std::uint32_t>(aircraft_ + column.task));
  added.group = std::move(column);
  columns_.push_back(std::move(added));
  return columns_.size() - 1;
}

double GroupMaster::amount(std::size_t j) const {
  return columns_[j].basic == kNotBasic ? 0 : amount_[columns_[j].basic];
}

double GroupMaster::value() const {
  double value = 0;
  for (std::size_t r = 0; r < rows_; ++r)
    value += columns_[basis_[r]].utility * amount_[r];
  return value;
}

void GroupMaster::find_prices() {
  std::fill(price_.begin(), price_.end(), 0.0);
  for (std::size_t r = 0; r < rows_; ++r) {
    const double utility = columns_[basis_[r]].utility;
    if (utility == 0) continue;
    const double* row = inverse(r);
    for (std::size_t k = 0; k < rows_; ++k) price_[k] += utility * row[k];
  }
}

std::size_t GroupMaster::entering() const {
  double most = kTiny;
  std::size_t best = columns_.size();
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    const Column& column = columns_[j];
    if (column.basic != kNotBasic) continue;
    double reduced = column.utility;
    for (const std::uint32_t r : column.rows) reduced -= price_[r];
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
    for (const std::uint32_t k : columns_[j].rows) direction[r] += row[k];
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
  columns_[basis_[leaves]].basic = kNotBasic;
  columns_[j].basic = static_cast<std::uint32_t>(leaves);
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
    for (const std::uint32_t k : columns_[basis_[r]].rows) matrix[k * rows_ + r] = 1;
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
  for (std::int64_t step = 0;; ++step) {
    find_prices();
    const std::size_t j = entering();
    if (j == columns_.size()) return true;
    if (step >= max_steps || !enter(j)) return false;
  }
}

}  // namespace skein::allocation
