// SPDX-License-Identifier: Apache-2.0
// Routing protocols: one row each.

#include <memory>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/layer/communication/routing/flooding.h"
#include "skein/layer/communication/routing/learned_routes.h"
#include "skein/layer/communication/routing/no_routing.h"

namespace skein::assemble {
namespace {

using communication::FloodingOptions;
using communication::LearnedRoutesOptions;
using scenario::Fields;

// Of options that have those of flooding at `place`.
template <class T, class Place>
Fields<T> flooding_fields(Place place) {
  return Fields<T>()
      .integer("hops", [place](T & t) -> auto& { return place(t).hops; },
               "Radios that may pass a message on.", {.at_least = 1, .at_most = 100})
      .duration_s("relay_delay_s", [place](T & t) -> auto& { return place(t).delay; },
                  "Each waits up to this.", {.at_least = 0, .at_most = 10});
}

}  // namespace

Kinds<Routing, RoutingContext> routing_kinds() {
  Kinds<Routing, RoutingContext> kinds("routing");
  kinds.add("none", "Nobody passes anything on: messages go to who hears their sender.",
            Fields<communication::NoRoutingOptions>(),
            [](const communication::NoRoutingOptions&, const RoutingContext&) {
              return std::make_unique<communication::NoRouting>();
            });
  kinds.add("flooding",
            "All pass on, once, what its sender cannot tell its receiver directly.",
            flooding_fields<FloodingOptions>([](auto& t) -> auto& { return t; }),
            [](const FloodingOptions& o, const RoutingContext& c) {
              return std::make_unique<communication::Flooding>(o, c.entities, c.seed);
            });
  kinds.add(
      "learned-routes",
      "Flooding that learns: who gets a message by a third one knows the way back.",
      flooding_fields<LearnedRoutesOptions>([](auto& t) -> auto& { return t.flooding; })
          .duration_s("lifetime_s", &LearnedRoutesOptions::lifetime,
                      "Of a route that no message confirms.",
                      {.above = 0, .at_most = 3600}),
      [](const LearnedRoutesOptions& o, const RoutingContext& c) {
        return std::make_unique<communication::LearnedRoutes>(o, c.entities, c.seed);
      });
  return kinds;
}

}  // namespace skein::assemble
