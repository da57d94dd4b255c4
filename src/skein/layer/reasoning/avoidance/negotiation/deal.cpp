// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/negotiation/deal.h"

#include <cmath>

#include "skein/base/check.h"

namespace skein::reasoning {
namespace {

void check_sizes(const Bargain& bargain) {
  SKEIN_CHECK(bargain.free.size() == bargain.u1.size() * bargain.u2.size());
  for (const auto* utilities : {&bargain.u1, &bargain.u2})
    for (const double u : *utilities) SKEIN_CHECK(std::isfinite(u) && u >= 0, u);
}

// Calls visit(deal) for the free pairs, in the order of k, then l.
template <class Visit>
void for_each_free(const Bargain& bargain, Visit&& visit) {
  for (std::size_t k = 0; k < bargain.u1.size(); ++k)
    for (std::size_t l = 0; l < bargain.u2.size(); ++l)
      if (bargain.is_free(k, l)) visit(Deal{k, l});
}

template <class Worth>
std::optional<Deal> best(const Bargain& bargain, Worth&& worth) {
  std::optional<Deal> found;
  double most = 0;
  for_each_free(bargain, [&](const Deal& deal) {
    const double value = worth(deal);
    if (found && value <= most) return;
    found = deal;
    most = value;
  });
  return found;
}

// The monotonic concession protocol. Side 0 is aircraft 1, side 1 aircraft 2.
class Concessions {
 public:
  explicit Concessions(const Bargain& bargain) : bargain_(bargain) {}

  std::optional<Agreement> run() {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      const auto first = best_for(side, [](const Deal&) { return true; });
      if (!first) return std::nullopt;
      proposal_[side] = *first;
    }
    Agreement agreement;
    while (true) {
      if (const auto deal = ended()) {
        agreement.deal = *deal;
        return agreement;
      }
      concede(risk(0) <= risk(1) ? std::size_t{0} : std::size_t{1});
      ++agreement.rounds;
    }
  }

 private:
  double utility(std::size_t side, const Deal& deal) const {
    return side == 0 ? bargain_.u1[deal.k] : bargain_.u2[deal.l];
  }
  double product(const Deal& deal) const { return utility(0, deal) * utility(1, deal); }

  // Whether the other's proposal gives at least what the own does.
  bool is_content(std::size_t side) const {
    return utility(side, proposal_[1 - side]) >= utility(side, proposal_[side]);
  }
  // Above 0 is what it divides by: who asks for nothing is content.
  double risk(std::size_t side) const {
    if (is_content(side)) return 0;
    const double own = utility(side, proposal_[side]);
    return (own - utility(side, proposal_[1 - side])) / own;
  }

  std::optional<Deal> ended() const {
    const bool first = is_content(0), second = is_content(1);
    if (first && second)
      return product(proposal_[0]) >= product(proposal_[1]) ? proposal_[0] : proposal_[1];
    if (first) return proposal_[1];
    if (second) return proposal_[0];
    return std::nullopt;
  }

  // The best for a side among free pairs; of equal ones the better one for the other,
  // then the lowest k, l.
  template <class Allowed>
  std::optional<Deal> best_for(std::size_t side, Allowed&& allowed) {
    std::optional<Deal> found;
    for_each_free(bargain_, [&](const Deal& deal) {
      if (found) {
        const double more = utility(side, deal) - utility(side, *found);
        const double more_other = utility(1 - side, deal) - utility(1 - side, *found);
        if (more < 0 || (more == 0 && more_other <= 0)) return;
      }
      if (allowed(deal)) found = deal;
    });
    return found;
  }

  void concede(std::size_t side) {
    const Deal last = proposal_[side];
    const double given = utility(1 - side, last);
    const auto next = best_for(side, [&](const Deal& deal) {
      if (utility(1 - side, deal) <= given) return false;
      proposal_[side] = deal;
      const bool enough = is_content(1 - side) || risk(1 - side) < risk(side);
      proposal_[side] = last;
      return enough;
    });
    // The other's own proposal is always such a deal.
    SKEIN_CHECK(next.has_value());
    proposal_[side] = *next;
  }

  const Bargain& bargain_;
  std::array<Deal, 2> proposal_;
};

}  // namespace

std::optional<Agreement> agree(DealRule rule, const Bargain& bargain) {
  check_sizes(bargain);
  if (rule == DealRule::kZeuthen) return Concessions(bargain).run();
  const auto found = best(bargain, [&](const Deal& deal) {
    const double first = bargain.u1[deal.k], second = bargain.u2[deal.l];
    return rule == DealRule::kSum ? first + second : first * second;
  });
  if (!found) return std::nullopt;
  return Agreement{*found, 0};
}

}  // namespace skein::reasoning
