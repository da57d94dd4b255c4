// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/traffic/separation.h"

// What aircraft say to each other to keep apart. Numbers are as short as they may be: all
// of this goes over slow modems.

namespace skein {

/// Who flies on where two meet: the higher class, in it the lower id.
enum class FlightPriority : std::uint8_t {
  kNormal,
  kLanding,          ///< on its approach
  kCannotManoeuvre,  ///< its energy is below what brings it home
  kManned,
  kPilotFlies,  ///< a safety pilot has taken over
  kEmergency,   ///< a failsafe flies
};
constexpr auto names_of(const FlightPriority*) {
  return std::to_array<std::string_view>(
      {"normal", "landing", "cannot-manoeuvre", "manned", "pilot-flies", "emergency"});
}

/// Whoever has it flies on: nothing can be agreed on with it.
constexpr bool flies_on(FlightPriority priority) {
  return priority == FlightPriority::kLanding ||
         priority == FlightPriority::kPilotFlies ||
         priority == FlightPriority::kEmergency;
}

/// The flight that the sender flies, to everyone.
struct PlanReport {
  std::uint32_t number = 0;  ///< grows with every other plan; the newest counts
  std::uint32_t agreed = 0;  ///< number of the negotiation that it comes from; 0: none
  FlightPriority priority = FlightPriority::kNormal;
  float horizontal = 50;   ///< separation that the sender keeps [m]
  float vertical = 20;     ///< [m]
  float across_error = 8;  ///< how far it is off its plan, sideways and along [m]
  float height_error = 2;  ///< [m]
  std::vector<std::uint8_t> flight;  ///< as model::coded_flight() makes it
};

constexpr auto describe(const PlanReport*) {
  using T = PlanReport;
  return described<T>(
      {"plan_report"}, "The flight that the sender flies.",
      field("plan_number", &T::number, "the newest counts"),
      field("agreed", &T::agreed, "number of the negotiation it comes from; 0: none"),
      field("priority", &T::priority, "who flies on where two meet"),
      field("horizontal", &T::horizontal, unit::kMetre, "separation that it keeps"),
      field("vertical", &T::vertical, unit::kMetre, "the same, up and down"),
      field("across_error", &T::across_error, unit::kMetre, "how far it is off its plan"),
      field("height_error", &T::height_error, unit::kMetre, "the same, up and down"),
      field("flight", &T::flight, Storage::kBytes, "its pieces, coded"));
}

/// Where the sender is when it says so, to everyone, once a second.
struct PlaceReport {
  float north = 0, east = 0, down = 0;        ///< [m]
  float v_north = 0, v_east = 0, v_down = 0;  ///< over ground [m/s]
  std::uint32_t plan = 0;  ///< number of the plan that it flies; 0: none that it can say
};

constexpr auto describe(const PlaceReport*) {
  using T = PlaceReport;
  return described<T>({"place_report"}, "Where the sender is.",
                      field("north", &T::north, unit::kMetre, "position"),
                      field("east", &T::east, unit::kMetre, "position"),
                      field("down", &T::down, unit::kMetre, "position"),
                      field("v_north", &T::v_north, unit::kMetrePerSecond, "over ground"),
                      field("v_east", &T::v_east, unit::kMetrePerSecond, "over ground"),
                      field("v_down", &T::v_down, unit::kMetrePerSecond, "over ground"),
                      field("plan_number", &T::plan, "the plan that it flies; 0: none"));
}

/// The sender and the receiver will not be apart: opens a negotiation. Times are seconds
/// on the run's clock.
struct ConflictNotice {
  std::uint32_t negotiation = 0;  ///< counts those that the sender opens, from 1
  std::uint32_t own_plan = 0;     ///< number of the sender's plan
  std::uint32_t other_plan = 0;   ///< number of the receiver's plan
  float begin = 0;                ///< what is agreed on begins then
  float meets = 0, closest = 0, apart = 0;  ///< of the conflict
  float horizontal = 50, vertical = 20;     ///< that the two have to keep [m]
};

constexpr auto describe(const ConflictNotice*) {
  using T = ConflictNotice;
  return described<T>(
      {"conflict_notice"}, "The sender and the receiver will not be apart.",
      field("negotiation", &T::negotiation, "counts those of the sender"),
      field("own_plan", &T::own_plan, "number of the sender's plan"),
      field("other_plan", &T::other_plan, "number of the receiver's plan"),
      field("begin", &T::begin, unit::kSecond, "what is agreed on begins then"),
      field("meets", &T::meets, unit::kSecond, "when they come too near"),
      field("closest", &T::closest, unit::kSecond, "when they are closest"),
      field("apart", &T::apart, unit::kSecond, "when they are apart again"),
      field("horizontal", &T::horizontal, unit::kMetre, "that the two have to keep"),
      field("vertical", &T::vertical, unit::kMetre, "the same, up and down"));
}

/// Something that the sender can do about a conflict, and what that costs it.
struct OfferedManoeuvre {
  std::uint8_t kind = 0;  ///< reasoning::ManoeuvreKind
  float amount = 0;       ///< its parameters
  float lead = 0;
  float cost = 0;  ///< [s]
};

constexpr auto describe(const OfferedManoeuvre*) {
  using T = OfferedManoeuvre;
  return described<T>({"offered_manoeuvre"}, "Something that can be done, and its cost.",
                      field("manoeuvre", &T::kind, "which kind"),
                      field("amount", &T::amount, "how much of it"),
                      field("lead", &T::lead, "how long before the conflict"),
                      field("cost", &T::cost, unit::kSecond, "to the sender"));
}

/// What the sender can fly: with the same numbers others make the same flights.
struct FlownLimits {
  float airspeed = 0, turn_radius = 0;          ///< at cruise [m/s], [m]
  float slowest = 0, fastest = 0;               ///< airspeeds [m/s]
  float climb = 0, sink = 0, acceleration = 0;  ///< vertical speeds [m/s], [m/s^2]
};

constexpr auto describe(const FlownLimits*) {
  using T = FlownLimits;
  return described<T>(
      {"flown_limits"}, "What an aircraft can fly.",
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "cruise"),
      field("turn_radius", &T::turn_radius, unit::kMetre, "smallest, at cruise"),
      field("slowest", &T::slowest, unit::kMetrePerSecond, "level flight"),
      field("fastest", &T::fastest, unit::kMetrePerSecond, "level flight"),
      field("climb", &T::climb, unit::kMetrePerSecond, "largest"),
      field("sink", &T::sink, unit::kMetrePerSecond, "largest"),
      field("acceleration", &T::acceleration, unit::kMetrePerSecondSquared,
            "largest change of the climb rate"));
}

/// All that the sender can do about a conflict, and what the receiver needs to make the
/// same flights of it.
struct Offers {
  EntityId opener;                ///< who has opened the negotiation
  std::uint32_t negotiation = 0;  ///< its number
  std::uint8_t deal = 0;          ///< reasoning::DealRule by which the sender agrees
  float strength = 1;
  float rejoins = 0;  ///< where its plan must be met again, by the time of the plan [s]
  FlownLimits limits;
  std::vector<OfferedManoeuvre> manoeuvres;
};

constexpr auto describe(const Offers*) {
  using T = Offers;
  return described<T>(
      {"offers"}, "All that the sender can do about a conflict.",
      field("opener", &T::opener, "who has opened the negotiation"),
      field("negotiation", &T::negotiation, "its number"),
      field("deal", &T::deal, "by which rule the sender agrees"),
      field("strength", &T::strength, "of the manoeuvres"),
      field("rejoins", &T::rejoins, unit::kSecond, "where its plan must be met again"),
      field("", &T::limits, "what it can fly"),
      field("manoeuvres", &T::manoeuvres, "what it can do"));
}

/// What comes out by the offers of both, as the sender has worked it out, and that it
/// will fly its part.
struct Acceptance {
  EntityId opener;                ///< who has opened the negotiation
  std::uint32_t negotiation = 0;  ///< its number
  float strength = 1;             ///< of the offers
  std::uint16_t of_opener = 0;    ///< which of the opener's manoeuvres
  std::uint16_t of_other = 0;     ///< which of the other's
};

constexpr auto describe(const Acceptance*) {
  using T = Acceptance;
  return described<T>({"acceptance"}, "The sender flies its part of what comes out.",
                      field("opener", &T::opener, "who has opened the negotiation"),
                      field("negotiation", &T::negotiation, "its number"),
                      field("strength", &T::strength, "of the offers"),
                      field("of_opener", &T::of_opener, "which of its manoeuvres"),
                      field("of_other", &T::of_other, "which of the other's"));
}

/// The sender does not negotiate now.
struct Busy {
  EntityId opener;
  std::uint32_t negotiation = 0;  ///< that it does not take part in
  bool other_plan = false;        ///< it flies another plan than the one that was named
};

constexpr auto describe(const Busy*) {
  using T = Busy;
  return described<T>({"busy"}, "The sender does not negotiate now.",
                      field("opener", &T::opener, "who has opened the negotiation"),
                      field("negotiation", &T::negotiation, "its number"),
                      field("other_plan", &T::other_plan, "its plan is another one"));
}

/// A member of a group that solves its conflicts together.
struct GroupMember {
  EntityId who;
  std::uint32_t plan = 0;  ///< number of the plan that it flies
};

constexpr auto describe(const GroupMember*) {
  using T = GroupMember;
  return described<T>({"group_member"}, "A member of a group.",
                      field("entity_id", &T::who, "which aircraft"),
                      field("plan_number", &T::plan, "that it flies"));
}

/// The sender coordinates a group: those named take part if they fly these plans. Times
/// are seconds on the run's clock.
struct GroupInvitation {
  std::uint32_t group = 0;  ///< counts those that the sender has invited to, from 1
  float begin = 0;          ///< what is agreed on begins then
  float apart = 0;          ///< all conflicts are over then
  std::vector<GroupMember> members;  ///< without the sender
};

constexpr auto describe(const GroupInvitation*) {
  using T = GroupInvitation;
  return described<T>(
      {"group_invitation"}, "The sender coordinates a group.",
      field("group", &T::group, "counts those of the sender"),
      field("begin", &T::begin, unit::kSecond, "what is agreed on begins then"),
      field("apart", &T::apart, unit::kSecond, "all conflicts are over then"),
      field("members", &T::members, "who is invited"));
}

/// The sender takes part in a group.
struct GroupJoining {
  std::uint32_t group = 0;  ///< of the receiver
  float rejoins = 0;  ///< where its plan must be met again, by the time of the plan [s]
  FlownLimits limits;
};

constexpr auto describe(const GroupJoining*) {
  using T = GroupJoining;
  return described<T>(
      {"group_joining"}, "The sender takes part in a group.",
      field("group", &T::group, "of the receiver"),
      field("rejoins", &T::rejoins, unit::kSecond, "where its plan must be met again"),
      field("", &T::limits, "what it can fly"));
}

/// What one member of a group shall do.
struct GroupManoeuvre {
  EntityId who;
  std::uint8_t kind = 0;                    ///< reasoning::ManoeuvreKind
  float amount = 0, lead = 0;               ///< its parameters
  float meets = 0, closest = 0, apart = 0;  ///< the conflict that it is about [s]
  float horizontal = 50, vertical = 20;     ///< to be kept in it [m]
};

constexpr auto describe(const GroupManoeuvre*) {
  using T = GroupManoeuvre;
  return described<T>(
      {"group_manoeuvre"}, "What one member of a group shall do.",
      field("entity_id", &T::who, "which aircraft"),
      field("manoeuvre", &T::kind, "which kind"),
      field("amount", &T::amount, "how much of it"),
      field("lead", &T::lead, "how long before the conflict"),
      field("meets", &T::meets, unit::kSecond, "when they come too near"),
      field("closest", &T::closest, unit::kSecond, "when they are closest"),
      field("apart", &T::apart, unit::kSecond, "when they are apart again"),
      field("horizontal", &T::horizontal, unit::kMetre, "to be kept"),
      field("vertical", &T::vertical, unit::kMetre, "the same, up and down"));
}

/// What comes out for a group: who is not named goes on.
struct GroupPlan {
  std::uint32_t group = 0;        ///< of the sender
  std::vector<EntityId> members;  ///< who takes part, without the sender
  std::vector<GroupManoeuvre> manoeuvres;
};

constexpr auto describe(const GroupPlan*) {
  using T = GroupPlan;
  return described<T>({"group_plan"}, "What comes out for a group.",
                      field("group", &T::group, "of the sender"),
                      field("members", &T::members, "who takes part"),
                      field("manoeuvres", &T::manoeuvres, "who does not go on"));
}

/// The sender flies its part of what has come out, once all have said so; or does not.
struct GroupAcceptance {
  EntityId coordinator;
  std::uint32_t group = 0;
  bool accepted = true;
};

constexpr auto describe(const GroupAcceptance*) {
  using T = GroupAcceptance;
  return described<T>({"group_acceptance"}, "The sender flies its part, or does not.",
                      field("coordinator_id", &T::coordinator, "of the group"),
                      field("group", &T::group, "of the coordinator"),
                      field("accepted", &T::accepted, "it flies its part"));
}

/// The sender finds no flight that keeps out of the receiver's way, and asks it to give
/// way in this conflict. Times are seconds on the run's clock.
struct YieldRequest {
  std::uint32_t request = 0;     ///< counts those of the sender, from 1
  std::uint32_t own_plan = 0;    ///< number of the sender's plan
  std::uint32_t other_plan = 0;  ///< number of the receiver's plan
  float meets = 0, apart = 0;    ///< of the conflict
};

constexpr auto describe(const YieldRequest*) {
  using T = YieldRequest;
  return described<T>(
      {"yield_request"}, "The sender asks the receiver to give way in a conflict.",
      field("request", &T::request, "counts those of the sender"),
      field("own_plan", &T::own_plan, "number of the sender's plan"),
      field("other_plan", &T::other_plan, "number of the receiver's plan"),
      field("meets", &T::meets, unit::kSecond, "when they come too near"),
      field("apart", &T::apart, unit::kSecond, "when they are apart again"));
}

/// Whether the sender gives way in the conflict of a request.
struct YieldAnswer {
  std::uint32_t request = 0;  ///< of the receiver
  bool granted = false;
};

constexpr auto describe(const YieldAnswer*) {
  using T = YieldAnswer;
  return described<T>({"yield_answer"}, "Whether the sender gives way in a conflict.",
                      field("request", &T::request, "of the receiver"),
                      field("granted", &T::granted, "it gives way"));
}

/// A conflict that is over, as one of the aircraft saw it.
struct ConflictReport {
  EntityId other;
  Time seen;   ///< when it was seen first
  Time meets;  ///< when they would have come too near, as seen first
  SeparationMethod method = SeparationMethod::kNone;  ///< the last that acted
  std::string outcome;                                ///< what was done, for people
  std::uint32_t messages = 0, bytes = 0;              ///< that the aircraft sent about it
  double fixed_before = 0;   ///< between the plan that solved it and `meets` [s]
  double planned_ratio = 0;  ///< least distance over separation as planned in the end
  double flown_ratio = 0;    ///< the same as flown, by what both said of themselves
};

constexpr auto describe(const ConflictReport*) {
  using T = ConflictReport;
  return described<T>(
      {"conflict_report"}, "A conflict between two aircraft that is over.",
      field("other_id", &T::other, "with whom"),
      field("seen", &T::seen, "when it was seen first"),
      field("meets", &T::meets, "when they would have come too near"),
      field("method", &T::method, "the last that acted"),
      field("outcome", &T::outcome, "what was done"),
      field("messages", &T::messages, "that the aircraft sent about it"),
      field("bytes", &T::bytes, "of them"),
      field("fixed_before", &T::fixed_before, unit::kSecond,
            "between the plan that solved it and the conflict"),
      field("planned_ratio", &T::planned_ratio,
            "least distance over separation, as planned in the end"),
      field("flown_ratio", &T::flown_ratio, "the same as flown, by what both reported"));
}

}  // namespace skein
