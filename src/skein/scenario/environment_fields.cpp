// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/environment_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/scenario/numbers.h"
#include "skein/scenario/zones.h"

namespace skein::scenario {
namespace {

Fields<GustEvent> gust_fields() {
  using T = GustEvent;
  return Fields<T>()
      .duration_s("at_s", &T::at, "When aircraft enter it.")
      .required()
      .vector("velocity_mps", &T::velocity, "Of the air where the gust is strongest.",
              {.at_least = -100, .at_most = 100})
      .number("up_mps", &T::up, "Of the air where it is strongest.",
              {.at_least = -100, .at_most = 100})
      .boolean("in_body", &T::in_body,
               "The velocity is forward and right of the aircraft, not north and east.")
      .number("length_m", &T::length,
              "Distance through the air from nothing to full strength.", kLength)
      .number("hold_m", &T::hold,
              "Distance at full strength, before it falls as it rose.",
              {.at_least = 0, .at_most = 1e6});
}

Fields<ZoneSwitch> switch_fields() {
  using T = ZoneSwitch;
  return Fields<T>()
      .duration_s("at_s", &T::at, "When the ground station says so.")
      .required()
      .boolean("on", &T::on, "The zone comes into force; else it is taken back.");
}

Fields<NoFlightZone> zone_fields() {
  using T = NoFlightZone;
  constexpr Range kAltitude{.at_least = -1000, .at_most = 100000};
  return Fields<T>()
      .text("name", &T::name, "What it is called; each name once.")
      .required()
      .polygon("ring_m", &T::ring, "Its corners. Null: it is a disc.")
      .point("centre_m", &T::centre, "Centre of a disc. Null: it has corners.")
      .number("radius_m", &T::radius, "Radius of a disc. Null: it has corners.", kLength)
      .number("floor_msl_m", &T::floor_msl,
              "Lowest altitude that is forbidden, above mean sea level. Null: no limit.",
              kAltitude)
      .number("ceiling_msl_m", &T::ceiling_msl,
              "Highest altitude that is forbidden, above mean sea level. Null: no limit.",
              kAltitude)
      .duration_s("from_s", &T::from, "Forbidden from then on. Null: no limit.")
      .duration_s("until_s", &T::until, "Forbidden until then. Null: no limit.")
      .boolean("active", &T::active,
               "In force from the start. Else it comes with the first "
               "switch, or when the operator names it.")
      .object("switches", &T::switches, switch_fields(),
              "When the ground station puts it into force and takes it back, by radio.")
      .items({.at_most = 1000})
      .rules(zone_errors);
}

Fields<PlacedObject> object_fields() {
  using T = PlacedObject;
  return Fields<T>()
      .text("name", &T::name, "What it is.")
      .point("position_m", &T::position, "Where it is at the start.")
      .word("class", &T::what,
            "What it is: how fast what is known of it grows old follows from that.",
            {{"person", ObjectClass::kPerson, "remembered for 10 minutes"},
             {"animal", ObjectClass::kAnimal, "remembered for 5 minutes"},
             {"vehicle", ObjectClass::kVehicle, "remembered for 5 minutes"},
             {"structure", ObjectClass::kStructure, "stands; never forgotten"}})
      .kind("movement", &T::movement, "movement", "How it moves.")
      .boolean(
          "physical", &T::physical,
          "It exists in reality (here its motion stands for it): the server knows of "
          "it only what physical sensors have seen.")
      .number("radius_m", &T::radius,
              "Physical: of its body, an upright cylinder. Null: person 0.5, animal 1, "
              "vehicle 3, structure 5.",
              {.above = 0, .at_most = 10000})
      .number("height_m", &T::height,
              "Physical: of its body. Null: person 2, animal 1.5, vehicle 3, structure "
              "20.",
              {.above = 0, .at_most = 10000})
      .rule("physical", [](const T& t) {
        return !t.physical && (t.radius || t.height)
                   ? std::string(
                         "is needed: only physical objects have radius_m and "
                         "height_m.")
                   : std::string();
      });
}

Fields<ServerMemory> memory_fields() {
  using T = ServerMemory;
  constexpr Range kAge{.above = 0};
  constexpr Range kDistance{.at_least = 0, .at_most = 10000};
  constexpr IntegerRange kLooks{.at_least = 1, .at_most = 1000};
  const auto max_age = [](ObjectClass what) {
    return [what](T & t) -> auto& {
      return t.forgetting.max_age[static_cast<std::size_t>(what)];
    };
  };
  return Fields<T>()
      .word("model", [](T & t) -> auto& { return t.forgetting.model; },
            "What makes the server forget where a physical object was seen.",
            {{"temporal", ForgettingModel::kTemporal, "its age"},
             {"logical", ForgettingModel::kLogical,
              "physical sensors that looked there and did not find it"}})
      .duration_s("person_max_age_s", max_age(ObjectClass::kPerson),
                  "Temporal: how long a person is remembered unseen. Null: for good.",
                  kAge)
      .duration_s("animal_max_age_s", max_age(ObjectClass::kAnimal),
                  "Temporal: how long an animal is remembered unseen. Null: for good.",
                  kAge)
      .duration_s("vehicle_max_age_s", max_age(ObjectClass::kVehicle),
                  "Temporal: how long a vehicle is remembered unseen. Null: for good.",
                  kAge)
      .duration_s("structure_max_age_s", max_age(ObjectClass::kStructure),
                  "Temporal: how long a structure is remembered unseen. Null: for good.",
                  kAge)
      .word("stable", [](T & t) -> auto& { return t.forgetting.stable; },
            "Classes that do not move; all others are unstable.",
            {{"person", ObjectClass::kPerson, "people"},
             {"animal", ObjectClass::kAnimal, "animals"},
             {"vehicle", ObjectClass::kVehicle, "vehicles"},
             {"structure", ObjectClass::kStructure, "structures"}})
      .integer(
          "unstable_looks", [](T & t) -> auto& { return t.forgetting.unstable_looks; },
          "Pictures of its place, one after the other, without it, after which an "
          "unstable object is not there any more. Logical: it is forgotten.",
          kLooks)
      .integer(
          "stable_looks", [](T & t) -> auto& { return t.forgetting.stable_looks; },
          "The same of a stable object.", kLooks)
      .number("moved_m", &T::moved,
              "Seen further than this and three standard deviations from where it was "
              "remembered, it has moved.",
              kDistance)
      .number("safety_radius_m", &T::safety_radius,
              "A virtual aircraft that passed the body of a stable object nearer than "
              "this, before anybody had seen it, would have met it.",
              kDistance);
}

}  // namespace

Fields<Environment> environment_fields() {
  using T = Environment;
  return Fields<T>()
      .kind("terrain", &T::terrain, "terrain", "Height of the ground.")
      .kind("wind", &T::wind, "wind", "Wind in space and time.")
      .kind("turbulence", &T::turbulence, "turbulence",
            "What each aircraft feels beyond the mean wind.")
      .object("gusts", &T::gusts, gust_fields(), "Single gusts, which all aircraft meet.")
      .items({.at_most = 10000})
      .kind("phenomena", &T::phenomena, "phenomenon",
            "True fires, and whatever else grows with a sharp boundary. Sensors and "
            "missions name them by their number, from 0.")
      .items({.at_most = 1000})
      .duration_s("period_s", &T::period,
                  "Time between two steps of phenomena. Null: every second, and as often "
                  "as a sensor looks at them and metrics are taken.",
                  kPeriod)
      .polygon("zones_m", &T::zone_rings,
               "No-fly zones at all altitudes and times, each a list of its corners.")
      .items({.at_most = 1000})
      .object("zones", &T::zones, zone_fields(),
              "No-fly zones with names, floors, ceilings, times and switches.")
      .items({.at_most = 1000})
      .rules_of_valid(zone_list_errors)
      .object("objects", &T::objects, object_fields(),
              "Things on the ground, for cameras to find.")
      .items({.at_most = 10000})
      .object(
          "memory", &T::memory, memory_fields(),
          "What the server remembers of physical objects; see docs/mixed-reality.md.");
}

std::initializer_list<Word<Transmitter>> transmitter_words() {
  static const std::initializer_list<Word<Transmitter>> kWords = {
      {"ads-b", Transmitter::kAdsB, "it broadcasts place and velocity, far"},
      {"flarm", Transmitter::kFlarm, "it broadcasts place and velocity, near"},
      {"transponder", Transmitter::kTransponder,
       "it answers radars, for passive detectors to hear"}};
  return kWords;
}

Fields<TrafficGroup> traffic_fields() {
  using T = TrafficGroup;
  return Fields<T>()
      .text("name", &T::name,
            "Name of the group; its aircraft are name-1, name-2, ... One alone has the "
            "name itself.")
      .integer("count", &T::count, "How many aircraft.",
               {.at_least = 0, .at_most = 10000})
      .kind("flight", &T::flight, "traffic", "How they fly.")
      .point("position_m", &T::position, "Where they come. Recorded ones know.")
      .number("spread_m", &T::spread,
              "Each comes within so far of there, at random, evenly over the disc.",
              {.at_least = 0, .at_most = 1e6})
      .number("altitude_msl_m", &T::altitude_msl,
              "Altitude when they come, above mean sea level.",
              {.at_least = -500, .at_most = 30000})
      .word("transmits", &T::transmits,
            "What they carry by which others may notice them. Radars find them without.",
            transmitter_words())
      .items({.at_most = 3})
      .integer("address", &T::address,
               "Of 24 bits, that it sends: two may have the same by mistake. Null: each "
               "has one of its own.",
               {.at_least = 0, .at_most = 0xFFFFFF})
      .duration_s("join_s", &T::join,
                  "When they come; times of recorded ones count from there.")
      .duration_s("leave_s", &T::leave, "When they are gone. Null: never.")
      .rule("leave_s", [](const T& t) {
        const bool early = t.leave && *t.leave <= t.join;
        return early ? std::string("must be after join_s.") : std::string();
      });
}

}  // namespace skein::scenario
