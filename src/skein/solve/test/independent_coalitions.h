// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

// Checks of coalitions that share no code with the solver, not even its types: numbers
// in, numbers out. Arithmetic is in long double.
namespace independent {

/// How a group satisfies a task, as the definition has it.
enum class Form { kRootFromOne, kLargest, kSumUpToOne };

struct Task {
  Form form = Form::kRootFromOne;
  std::vector<double> brings, cost;  // by aircraft
};

struct Coalitions {
  std::size_t aircraft = 0;
  bool idle_allowed = true;
  std::vector<Task> tasks;
};

/// The utility of an allocation; -1: idle. Minus infinity where somebody is idle who may
/// not be.
long double utility(const Coalitions& problem, const std::vector<int>& task_of);

/// The highest utility there is, by dynamic programming over all subsets of the aircraft,
/// one task after the other. 3^n for each task: up to 16 aircraft.
long double best_utility(const Coalitions& problem);

/// A part of all allocations in a proof: prices that bound it, and the membership that
/// splits it in two where they do not close it.
struct ProofPart {
  std::vector<double> price;  // empty: it is split without
  std::size_t task = 0, aircraft = 0;
  std::size_t with = 0, without = 0;  // parts; 0: none
};

/// Whether a proof shows that no allocation is worth more than `claimed` by more than
/// `tolerance`.
///
/// From the prices of each part alone: those of aircraft plus, of each task, the group
/// worth most under them. The groups are found by a search of its own, over costs rather
/// than over what they bring. Memberships that a part's prices exclude are left out of
/// the parts below it. `parts[0]` holds all allocations.
bool is_proof(const Coalitions& problem, const std::vector<ProofPart>& parts,
              long double claimed, long double tolerance);

}  // namespace independent
