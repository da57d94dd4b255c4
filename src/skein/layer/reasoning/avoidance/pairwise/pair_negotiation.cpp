// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/said_limits.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kStep = 1;    // both answer so late at most [s]
constexpr double kBudget = 3;  // of time, besides that of messages [s]
constexpr std::size_t kMaxOffers = 200;
constexpr double kWorthless = 120;  // cost of an option without utility [s]

ConflictOfFlight about(const FlightPlan& plan, const FlightLimits& limits,
                       const NegotiatedConflict& c) {
  return {plan, limits, c.begin, c.meets, c.closest, c.apart, c.separation};
}

FlightPlan until_rejoining(const NegotiatingFlight& flight) {
  return solve::part_of(flight.plan, model::start_of(flight.plan), flight.rejoins);
}

Manoeuvre manoeuvre_of(const OfferedManoeuvre& offered) {
  return {static_cast<ManoeuvreKind>(offered.kind), offered.amount, offered.lead};
}

bool makes_sense(const Offers& offers) {
  if (offers.manoeuvres.size() > kMaxOffers) return false;
  for (const OfferedManoeuvre& each : offers.manoeuvres)
    if (each.kind > static_cast<std::uint8_t>(ManoeuvreKind::kSpeed) ||
        !std::isfinite(each.amount) || !std::isfinite(each.lead) ||
        !std::isfinite(each.cost))
      return false;
  if (offers.deal > static_cast<std::uint8_t>(DealRule::kZeuthen)) return false;
  return are_possible(offers.limits) && std::isfinite(offers.rejoins);
}

}  // namespace

double utility_of(double cost) {
  return std::clamp(1 - cost / kWorthless, 0.0, 1.0);
}

std::optional<FlightPlan> flight_with(const Manoeuvre& manoeuvre,
                                      const NegotiatingFlight& flight,
                                      const NegotiatedConflict& conflict) {
  const FlightPlan part = until_rejoining(flight);
  auto changed = manoeuvred(manoeuvre, about(part, flight.limits, conflict));
  if (changed) append_rest(*changed, flight.plan, flight.rejoins);
  return changed;
}

PairNegotiation::PairNegotiation(const NegotiatedConflict& conflict,
                                 NegotiatingFlight own, NegotiatingFlight other, Time now)
    : conflict_(conflict), own_(std::move(own)), other_(std::move(other)) {
  own_.limits = limits_of(said_limits(own_.limits));
  own_.rejoins = static_cast<float>(own_.rejoins);
  const double round_trip = 2 * conflict.delay + kStep;
  repeat_ = round_trip;
  deadline_ = std::min(now.seconds() + kBudget + 4 * round_trip, conflict.begin - kStep);
}

void PairNegotiation::fail(std::string_view why) {
  if (state_ != State::kOpen) return;
  state_ = State::kFailed;
  why_ = why;
}

void PairNegotiation::refuse(std::string_view why) {
  if (!my_acceptance_) fail(why);
}

void PairNegotiation::take(const Offers& offers) {
  if (!makes_sense(offers)) return fail("offers that make no sense");
  for (std::size_t k = 0; k < kStrengths.size(); ++k)
    if (static_cast<float>(kStrengths[k]) == offers.strength && !theirs_[k].offers) {
      theirs_[k].offers = offers;
      // What it can fly is said with the first of its offers.
      other_.rejoins = offers.rejoins;
      other_.limits = limits_of(offers.limits);
      return;
    }
  // It has been received already: the other has not heard the answer.
  said_ = Time();
}

void PairNegotiation::take(const Acceptance& acceptance) {
  their_acceptance_ = acceptance;
}

void PairNegotiation::make_offers(const NegotiationView& view) {
  Side& side = mine_[strength_];
  const FlightLimits& limits = own_.limits;
  Offers offers;
  offers.opener = conflict_.name.opener;
  offers.negotiation = conflict_.name.number;
  offers.deal = static_cast<std::uint8_t>(conflict_.deal);
  offers.strength = static_cast<float>(kStrengths[strength_]);
  offers.rejoins = static_cast<float>(own_.rejoins);
  offers.limits = said_limits(limits);
  const FlightPlan part = until_rejoining(own_);
  for (Candidate& each : candidates(about(part, limits, conflict_), kStrengths[strength_],
                                    view.others, conflict_.look_until)) {
    append_rest(each.flight, own_.plan, own_.rejoins);
    if (each.manoeuvre.kind != ManoeuvreKind::kGoOn && view.is_free &&
        !view.is_free(each.flight))
      continue;
    offers.manoeuvres.push_back({static_cast<std::uint8_t>(each.manoeuvre.kind),
                                 static_cast<float>(each.manoeuvre.amount),
                                 static_cast<float>(each.manoeuvre.lead),
                                 static_cast<float>(each.cost)});
    side.flights.push_back(std::move(each.flight));
  }
  side.offers = std::move(offers);
}

// Those that the other's offers mean.
void PairNegotiation::make_flights() {
  Side& side = theirs_[strength_];
  if (!side.flights.empty()) return;
  for (const OfferedManoeuvre& each : side.offers->manoeuvres)
    side.flights.push_back(flight_with(manoeuvre_of(each), other_, conflict_));
}

bool PairNegotiation::are_apart(const Pair& pair) const {
  const auto& one = mine_[strength_].flights[pair.own];
  const auto& other = theirs_[strength_].flights[pair.other];
  return one && other &&
         !first_encounter(*one, *other, conflict_.separation, conflict_.begin,
                          conflict_.look_until);
}

std::optional<PairNegotiation::Pair> PairNegotiation::deal() const {
  const auto theirs = static_cast<DealRule>(theirs_[strength_].offers->deal);
  const DealRule rule = deal_rule_of(conflict_.deal, theirs);
  return rule == DealRule::kSum ? cheapest() : fairest(rule);
}

// The pair with the least sum of costs that is apart.
std::optional<PairNegotiation::Pair> PairNegotiation::cheapest() const {
  const Side& mine = mine_[strength_];
  const Side& theirs = theirs_[strength_];
  struct Ranked {
    float sum;
    std::size_t of_opener, of_other;
  };
  std::vector<Ranked> pairs;
  for (std::size_t k = 0; k < mine.flights.size(); ++k)
    for (std::size_t l = 0; l < theirs.flights.size(); ++l)
      pairs.push_back(
          {mine.offers->manoeuvres[k].cost + theirs.offers->manoeuvres[l].cost,
           opened() ? k : l, opened() ? l : k});
  std::ranges::sort(pairs, [](const Ranked& a, const Ranked& b) {
    return std::tuple(a.sum, a.of_opener, a.of_other) <
           std::tuple(b.sum, b.of_opener, b.of_other);
  });
  for (const Ranked& pair : pairs) {
    const Pair found{opened() ? pair.of_opener : pair.of_other,
                     opened() ? pair.of_other : pair.of_opener};
    if (are_apart(found)) return found;
  }
  return std::nullopt;
}

// The deal of utilities, the opener being aircraft 1.
std::optional<PairNegotiation::Pair> PairNegotiation::fairest(DealRule rule) const {
  const Side& of_opener = opened() ? mine_[strength_] : theirs_[strength_];
  const Side& of_other = opened() ? theirs_[strength_] : mine_[strength_];
  Bargain bargain;
  for (const OfferedManoeuvre& each : of_opener.offers->manoeuvres)
    bargain.u1.push_back(utility_of(each.cost));
  for (const OfferedManoeuvre& each : of_other.offers->manoeuvres)
    bargain.u2.push_back(utility_of(each.cost));
  const auto pair_of = [&](std::size_t k, std::size_t l) {
    return opened() ? Pair{k, l} : Pair{l, k};
  };
  for (std::size_t k = 0; k < bargain.u1.size(); ++k)
    for (std::size_t l = 0; l < bargain.u2.size(); ++l)
      bargain.free.push_back(bargain.u1[k] > 0 && bargain.u2[l] > 0 &&
                             are_apart(pair_of(k, l)));
  const auto agreed = agree(rule, bargain);
  if (!agreed) return std::nullopt;
  return pair_of(agreed->deal.k, agreed->deal.l);
}

// One step on. @returns whether something was done.
bool PairNegotiation::work(const NegotiationView& view) {
  if (state_ != State::kOpen) return false;
  if (strength_ == kStrengths.size()) {
    fail("no pair of manoeuvres is apart");
    return false;
  }
  if (!mine_[strength_].offers) {
    make_offers(view);
    changed_ = true;
    return true;
  }
  if (!theirs_[strength_].offers) return false;
  if (!my_acceptance_) {
    make_flights();
    const auto found = deal();
    changed_ = true;
    if (!found) {
      ++strength_;
      return true;
    }
    Side& mine = mine_[strength_];
    agreed_ = {manoeuvre_of(mine.offers->manoeuvres[found->own]),
               *mine.flights[found->own], 0};
    my_acceptance_ =
        Acceptance{conflict_.name.opener, conflict_.name.number,
                   static_cast<float>(kStrengths[strength_]),
                   static_cast<std::uint16_t>(opened() ? found->own : found->other),
                   static_cast<std::uint16_t>(opened() ? found->other : found->own)};
    return true;
  }
  if (their_acceptance_) {
    const bool same = their_acceptance_->strength == my_acceptance_->strength &&
                      their_acceptance_->of_opener == my_acceptance_->of_opener &&
                      their_acceptance_->of_other == my_acceptance_->of_other;
    if (same)
      state_ = State::kAgreed;
    else
      fail("the two do not find the same");
    return false;
  }
  if (other_flies_) state_ = State::kAgreed;
  return false;
}

void PairNegotiation::send(decltype(Message::content) content,
                           std::vector<Message>& out) const {
  out.push_back({conflict_.self, conflict_.other, 0, Time(), std::move(content)});
}

void PairNegotiation::say_again(std::vector<Message>& out) const {
  if (notice_ && !theirs_[0].offers) send(*notice_, out);
  // Who has made offers of a strength has received those of the weaker ones.
  std::size_t first = kStrengths.size() - 1;
  while (first > 0 && !theirs_[first].offers) --first;
  for (std::size_t k = first; k < kStrengths.size(); ++k)
    if (mine_[k].offers) send(*mine_[k].offers, out);
  if (my_acceptance_) send(*my_acceptance_, out);
}

void PairNegotiation::step(Time now, const NegotiationView& view,
                           std::vector<Message>& out) {
  if (state_ == State::kOpen && now.seconds() > deadline_) fail("no answer in time");
  const std::size_t offered = strength_;
  const bool had_offers =
      mine_[std::min(offered, kStrengths.size() - 1)].offers.has_value();
  while (work(view)) {
  }
  if (state_ == State::kFailed) return;
  if (changed_) {
    if (notice_ && !had_offers && offered == 0) send(*notice_, out);
    for (std::size_t k = offered; k < kStrengths.size(); ++k)
      if (mine_[k].offers && (k > offered || !had_offers)) send(*mine_[k].offers, out);
    if (my_acceptance_) send(*my_acceptance_, out);
    said_ = now;
    changed_ = false;
  } else if (state_ == State::kOpen && (now - said_).seconds() >= repeat_) {
    say_again(out);
    said_ = now;
  }
}

}  // namespace skein::reasoning
