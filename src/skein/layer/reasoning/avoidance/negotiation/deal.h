// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace skein::reasoning {

/// What two aircraft bargain over: options of each with its utility, and which pairs of
/// options are free of conflict. Numbers of options count from 0.
struct Bargain {
  std::vector<double> u1;          ///< utility of option k to aircraft 1, 0 or more
  std::vector<double> u2;          ///< utility of option l to aircraft 2, 0 or more
  std::vector<std::uint8_t> free;  ///< at k * u2.size() + l: 1 where k and l go together

  bool is_free(std::size_t k, std::size_t l) const {
    return free[k * u2.size() + l] != 0;
  }
};

/// A pair of options: k of aircraft 1, l of aircraft 2.
struct Deal {
  std::size_t k = 0;
  std::size_t l = 0;
  friend bool operator==(const Deal&, const Deal&) = default;
};

/// How a deal is chosen among the free pairs.
enum class DealRule : std::uint8_t {
  kSum,      ///< the most u1 + u2: among aircraft of one owner
  kProduct,  ///< the most u1 u2
  kZeuthen,  ///< by concessions, for aircraft of different owners
};
constexpr auto names_of(const DealRule*) {
  return std::array<std::string_view, 3>{"sum", "product", "zeuthen"};
}

/// A deal, and after how many concessions.
struct Agreement {
  Deal deal;
  int rounds = 0;  ///< of kZeuthen; 0 for the others
};

/// The deal that both aircraft find from the same table, each by itself.
///
/// kSum, kProduct: the pair with the most; of equal ones the lowest k, then l.
///
/// kZeuthen, the monotonic concession protocol: each proposes its best deal (of equal
/// ones that which gives the other more, then the lowest k, l). It ends when the other's
/// proposal gives one at least what its own does; when that is so for both, the proposal
/// of the larger product counts, of equal ones aircraft 1's. Until then the one with the
/// smaller risk
///
///   Z_i = (u_i(own proposal) - u_i(other's)) / u_i(own proposal)
///
/// concedes, aircraft 1 of equal ones: it proposes, among deals that give the other more
/// than its last proposal and after which the other's risk is the smaller one or the
/// other's protocol ends, the best for itself.
///
/// @returns  none when no pair is free.
/// Fails:    Bug when sizes do not fit or a utility is negative or not finite.
/// Cost:     O(pairs) for each concession; at most u1.size() + u2.size() concessions.
/// Reference: J. S. Rosenschein, G. Zlotkin, Rules of Encounter (1994), chapter 3;
///            F. Zeuthen, Problems of Monopoly and Economic Warfare (1930).
std::optional<Agreement> agree(DealRule rule, const Bargain& bargain);

}  // namespace skein::reasoning
