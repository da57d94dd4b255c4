// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/link/impairment/impairment.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// Adds the keys of an impairment.
///
/// @tparam T     the struct that is described.
/// @tparam Part  Impairment, or ImpairmentChange where keys that are not given change
///               nothing.
/// @param in     makes a member of T from a member of Part.
template <class Part, class T, class In>
void add_impairment_keys(scenario::Fields<T>& fields, In in) {
  using impairment::JitterKind;
  constexpr scenario::Range kProbability{.at_least = 0, .at_most = 1};
  constexpr scenario::Range kDelay{.at_least = 0, .at_most = 3600};
  fields
      .number("delay_s", in(&Part::delay), "From the end of transmission to arrival.",
              kDelay)
      .number("jitter_s", in(&Part::jitter),
              "Further delay; packets keep their order, so that a late one delays those "
              "behind it.",
              kDelay)
      .word("jitter_kind", in(&Part::jitter_kind), "How it is distributed.",
            {{"uniform", JitterKind::kUniform, "between 0 and `jitter_s`"},
             {"normal", JitterKind::kNormal,
              "about 0 with the standard deviation `jitter_s`; nothing arrives before it "
              "was sent"}})
      .number("loss", in(&Part::loss),
              "Probability that a packet is lost after its transmission. UDP only.",
              kProbability)
      .number("duplicate", in(&Part::duplicate),
              "Probability that a packet arrives twice. UDP only.", kProbability)
      .number("reorder", in(&Part::reorder),
              "Probability that a packet is held back, so that others pass it. UDP only.",
              kProbability)
      .number("reorder_s", in(&Part::reorder_delay), "How long it is held back.", kDelay)
      .number("rate_bps", in(&Part::rate),
              "Of transmission, of each session; 0: no limit.",
              {.at_least = 0, .at_most = 1e12})
      .integer("queue_bytes", in(&Part::queue_bytes),
               "That wait or are transmitted. UDP: a packet beyond is lost, but for one "
               "that finds the queue empty; TCP: nothing more is read.",
               {.at_least = 1, .at_most = 16 << 20})
      .boolean("cut", in(&Part::cut),
               "Nothing is transmitted. UDP: what comes in is lost; TCP: it waits.");
}

}  // namespace skein::assemble
