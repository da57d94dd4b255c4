// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/data/radio/message.h"
#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// Where somebody was when it said so.
struct ReportedPlace {
  Time sent;
  Vec3 p_N = Vec3::Zero();  ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  std::uint32_t plan = 0;   ///< that it says it flies; 0: none
};

/// What is known of another aircraft of the own team from what it has sent.
struct TeamFlight {
  EntityId who;
  FlightPlan plan;           ///< empty: none was received
  std::uint32_t number = 0;  ///< of the plan
  std::uint32_t agreed = 0;  ///< negotiation that the plan comes from; 0: none
  FlightPriority priority = FlightPriority::kNormal;
  Separation separation;       ///< that it keeps
  double across_error = 8;     ///< off its plan [m]
  double height_error = 2;     ///< [m]
  Time sent;                   ///< the newest report of the plan
  std::optional<Time> landed;  ///< it said so then; what it sent before says nothing
  std::optional<ReportedPlace> place;
  /// It was elsewhere than its plan has it, when it said so last.
  bool strays = false;
  FlightPlan course;  ///< straight on from the place reported last, if the plan does not
                      ///< conform; else empty
  std::uint32_t course_number = 0;  ///< of `course`; no plan has such a number
  double delay = 0;  ///< of what it sends, smoothed; the longest of late [s]
  double plan_holds = 15, place_holds = 10;  ///< so long after they were sent [s]

  /// Its plan says where it will be: heard of lately, and it is where the plan has it.
  bool conforms(Time now) const;

  /// What has to be counted with.
  struct Expected {
    const FlightPlan* plan = nullptr;  ///< null: nothing is known
    std::uint32_t number = 0;          ///< another one, another flight
    double unknown = 0;  ///< how far it may be off that, more than it says [m]
  };
  /// Its plan while it conforms; else straight on from where it was last, while that is
  /// not too long ago.
  /// @param now  of the last TeamFlights::listen().
  Expected expected(Time now) const;
};

/// The flights of the others of the team, from their PlanReports and PlaceReports; who
/// has said in a LandingReport that it has landed has none. What comes late, twice or in
/// another order changes nothing; what makes no sense is left out.
class TeamFlights {
 public:
  /// In periods of PlaceReports: a plan that has not been heard of for longer protects
  /// its owner no more.
  static constexpr double kPlanHolds = 15;
  /// The same: what has not been heard of for longer is forgotten.
  static constexpr double kForget = 60;

  /// @param horizon       how long courses are expected to be kept [s].
  /// @param place_period  of PlaceReports of all [s].
  explicit TeamFlights(double horizon = 90, double place_period = 1)
      : horizon_(horizon), place_period_(place_period) {}

  /// Takes in what was received and forgets who has been silent for long.
  void listen(EntityId self, Time now, std::span<const Message> inbox);

  std::span<const TeamFlight> flights() const { return flights_; }  ///< by id
  const TeamFlight* find(EntityId who) const;

  /// The share of what others send that does not arrive, by their PlaceReports of late.
  double loss() const;
  /// The same; while that is not known, what is usual.
  double loss_to_expect() const;

 private:
  TeamFlight& at(EntityId who);
  void expect_courses(Time now);
  static bool strays(const TeamFlight& flight);
  void take(const Message& message, const PlanReport& report);
  void take(const Message& message, const PlaceReport& report);
  void take(const Message& message, const LandingReport& report);

  double horizon_, place_period_;
  std::vector<TeamFlight> flights_;
  double received_ = 0, expected_ = 0;  // PlaceReports of late
  std::uint32_t courses_ = 0;
};

}  // namespace skein::reasoning
