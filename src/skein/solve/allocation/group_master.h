// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace skein::solve {

/// A group as a column of the linear program.
struct GroupColumn {
  std::uint32_t task = 0;
  std::vector<std::uint32_t> members;  ///< ascending
  double utility = 0;
};

/// The linear program over groups that are known so far:
///
///   maximise sum_j u_j x_j,  x_j >= 0,
///   for each aircraft  sum of x_j of its groups + s_i = 1,
///   for each task      sum of x_j of its groups + e_k = 1.
///
/// Primal simplex with the inverse of the basis; the right-hand sides are parted by some
/// 1e-8 so that it does not cycle. Prices are good to rounding only: what rests on them
/// must hold for any prices.
class GroupMaster {
 public:
  GroupMaster(std::size_t aircraft, std::size_t tasks);

  /// What staying idle is worth, and an empty task: 0, or a penalty where it is not
  /// allowed.
  void set_idle(std::size_t aircraft, double utility) { utility_[aircraft] = utility; }
  void set_empty(std::size_t task, double utility) {
    utility_[aircraft_ + task] = utility;
  }
  /// The number of the new column.
  std::size_t add(GroupColumn column);
  std::size_t columns() const { return utility_.size(); }
  const GroupColumn& column(std::size_t j) const { return groups_[j]; }
  /// What a group is worth; of one that is not allowed, a penalty: it does not enter.
  void set_utility(std::size_t j, double utility, bool allowed) {
    utility_[j] = utility;
    allowed_[j] = allowed;
  }
  std::size_t first_group() const { return aircraft_ + tasks_; }

  /// Solves it, from where it was. False when `max_steps` were not enough.
  bool solve(std::int64_t max_steps);

  /// Prices of aircraft, then of tasks.
  const std::vector<double>& prices() const { return price_; }
  /// How much of column j is taken; below 1e-5 is nothing.
  double amount(std::size_t j) const;
  double value() const;

 private:
  static constexpr std::uint32_t kNotBasic = 0xffffffff;

  void append(GroupColumn group, double utility, std::uint32_t basic);
  std::span<const std::uint32_t> rows_of(std::size_t j) const {
    return {members_.data() + first_[j], first_[j + 1] - first_[j]};
  }
  void find_prices();
  std::size_t entering() const;
  bool enter(std::size_t j);
  void invert();
  double* inverse(std::size_t row) { return inverse_.data() + row * rows_; }

  std::size_t aircraft_, tasks_, rows_;
  // By column. The rows that a column has are beside each other in `members_`, since the
  // search for the one that enters passes over all of them each time.
  std::vector<GroupColumn> groups_;
  std::vector<double> utility_;
  std::vector<std::uint32_t> basic_;  // its row of the basis
  std::vector<bool> allowed_;
  std::vector<std::uint32_t> may_enter_;  // the columns that are allowed
  std::vector<std::size_t> first_ = {0};
  std::vector<std::uint32_t> members_;
  std::vector<std::size_t> basis_;  // column of each row
  std::vector<double> inverse_, right_, amount_, price_;
  int since_inverted_ = 0;
};

}  // namespace skein::solve
