// SPDX-License-Identifier: Apache-2.0
// How things on the ground move: one row each.

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/layer/environment/object/evading_motion.h"
#include "skein/layer/environment/object/even_motion.h"
#include "skein/layer/environment/object/route_motion.h"

namespace skein::assemble {
namespace {

using namespace environment;
using scenario::Fields;
using scenario::Range;

constexpr Range kSpeed{.above = 0, .at_most = 100};
constexpr Range kDistance{.above = 0, .at_most = 1e6};

struct Standing {};

struct EvenChoice {
  Vec2 velocity = Vec2(1, 0);
};

Fields<EvenChoice> even_fields() {
  using T = EvenChoice;
  return Fields<T>().vector("velocity_mps", &T::velocity, "How it moves, over ground.",
                            {.at_least = -100, .at_most = 100});
}

struct RouteMotionChoice : RouteMotionOptions {
  RouteMotionChoice() { points = {{500, 0}}; }
};

Fields<RouteMotionChoice> route_motion_fields() {
  using T = RouteMotionChoice;
  return Fields<T>()
      .point("points_m", &T::points, "Where it goes, one after the other.")
      .items({.at_least = 1, .at_most = 10000})
      .number("speed_mps", &T::speed, "Over ground.", kSpeed)
      .word("then", &T::end, "What comes after the last point.",
            {{"stay", RouteEnd::kStay, "it stands there"},
             {"back", RouteEnd::kBack, "back the same way, again and again"},
             {"round", RouteEnd::kRound, "straight to where it began, again and again"}});
}

template <class T, class Member>
Fields<T> walk_fields(Member walk) {
  return Fields<T>()
      .number(
          "speed_mps", [walk](T & t) -> auto& { return walk(t).speed; }, "Over ground.",
          kSpeed)
      .number("mean_leg_s", [walk](T & t) -> auto& { return walk(t).mean_leg; },
              "Mean time between two changes of direction.",
              {.at_least = 1, .at_most = 1e6})
      .number(
          "radius_m", [walk](T & t) -> auto& { return walk(t).radius; },
          "It stays about so near to where it began. Null: it goes anywhere.", kDistance);
}

Fields<EvadingMotionOptions> evading_fields() {
  using T = EvadingMotionOptions;
  return walk_fields<T>([](T & t) -> auto& { return t.walk; })
      .number("flee_speed_mps", &T::flee_speed, "On the run.", kSpeed)
      .number("notice_m", &T::notice, "Horizontal distance at which it notices aircraft.",
              kDistance)
      .number("reaction_s", &T::reaction, "Time between two decisions on the run.",
              {.at_least = 0.1, .at_most = 3600})
      .angle_deg("zigzag_deg", &T::zigzag,
                 "It runs up to so far to either side of straight away from the nearest.",
                 {.at_least = 0, .at_most = 180})
      .number("calm_after_s", &T::calm_after,
              "It walks again when it has noticed none "
              "for so long.",
              {.at_least = 0, .at_most = 1e6});
}

}  // namespace

Kinds<MovingObject, ObjectContext> movement_kinds() {
  Kinds<MovingObject, ObjectContext> kinds("movement");
  kinds.add("standing", "Stays where it is.", Fields<Standing>(),
            [](const Standing&, const ObjectContext& c) {
              return std::make_unique<EvenMotion>(c.begin, Vec2::Zero());
            });
  kinds.add("even", "Straight on.", even_fields(),
            [](const EvenChoice& o, const ObjectContext& c) {
              return std::make_unique<EvenMotion>(c.begin, o.velocity);
            });
  kinds.add("route", "Along a route.", route_motion_fields(),
            [](const RouteMotionChoice& o, const ObjectContext& c) {
              return std::make_unique<RouteMotion>(c.begin, o);
            });
  kinds.add(
      "random-walk", "Straight on for random times in random directions.",
      walk_fields<RandomWalkOptions>([](RandomWalkOptions & t) -> auto& { return t; }),
      [](const RandomWalkOptions& o, const ObjectContext& c) {
        return std::make_unique<RandomWalk>(c.begin, o, c.seed, c.object);
      });
  kinds.add("evading", "A random walk; runs from aircraft that come near.",
            evading_fields(), [](const EvadingMotionOptions& o, const ObjectContext& c) {
              return std::make_unique<EvadingMotion>(c.begin, o, c.seed, c.object);
            });
  return kinds;
}

}  // namespace skein::assemble
