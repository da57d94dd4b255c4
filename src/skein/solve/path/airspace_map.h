// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/role/path_planner.h"
#include "skein/solve/path/obstacle.h"

namespace skein::solve {

/// What a flight comes into.
enum class Blocker : std::uint8_t { kZone, kMover, kFlight, kGround, kEdge };

/// Where and when a flight first comes into something.
struct Conflict {
  Blocker blocker = Blocker::kZone;
  std::size_t index = 0;    ///< of the zone, moving obstacle or flight
  std::size_t element = 0;  ///< of the plan
  double time = 0;          ///< on the run's clock [s]
  Vec3 p_N = Vec3::Zero();  ///< [m]
  double depth = 0;         ///< how deep within 2 s [m]; 0 where it is not known
  std::string what = {};    ///< for people: what, where, when, by how much
};

/// What an aircraft can come to, how quickly; see AirspaceMap::room.
struct Reach {
  double speed = 20;  ///< over ground at most [m/s]
  double climb = 3;   ///< up or down at most [m/s]
};

/// Whether flights are free in space and time: zones, moving obstacles, rooms of planned
/// flights, the ground and the edge of the map, in a tree of boxes of space and time.
///
/// What it calls free is never deeper than 0.1 m in a zone or another's room. The ground
/// is known at points only: between them it counts as no steeper than `kSteepest`, but
/// looks are never less than `kMinLook` apart.
class AirspaceMap {
 public:
  static constexpr double kSteepest = 2;  ///< height over distance
  static constexpr double kMinLook = 2;   ///< [m]

  /// Keeps pointers to the airspace and the terrain, which must outlive it. The airspace
  /// must be one that refuse_airspace() accepts.
  explicit AirspaceMap(const PathQuery& query);

  /// Asks for another flight in the same airspace, over the same terrain and area.
  void ask(const PathQuery& query);
  /// Adds another's planned flight; it must stay where it is.
  /// Cost: of N flights one by one N log^2 N.
  void add(const PlannedFlight& flight);

  bool is_free(const FlightElement& element) const;
  bool is_free(const FlightPlan& plan) const;
  /// The first conflict of a plan, if any, in words.
  std::optional<Conflict> first_conflict(const FlightPlan& plan) const;
  /// The same to 0.2 s, without depth and words: much quicker.
  std::optional<Conflict> first_meeting(const FlightPlan& plan) const;
  /// What is at a place at a time, if anything is.
  std::optional<Conflict> conflict_at(const Vec3& p_N, double time) const;

  /// The zones that a plan comes into, each once, in the order of their numbers.
  std::vector<std::size_t> zones_met(const FlightPlan& plan) const;

  /// Whether anything depends on the time.
  bool is_timed() const { return timed_; }
  /// How far one can fly from a place at least before anything could block it [m], up to
  /// `max`; 0 inside of something. The ground and the edge do not count.
  double room(const Vec3& p_N, double time, const Reach& reach, double max) const;
  /// The first time from `time` on at which a place is free, if it ever is.
  std::optional<double> free_from(const Vec3& p_N, double time) const;
  /// The nearest place found that is free at a time and within the map.
  std::optional<Vec3> nearest_free(const Vec3& p_N, double time) const;

  bool within(const Vec2& p) const;
  const PathQuery& query() const { return query_; }
  const Zone& zone(std::size_t index) const { return query_.airspace->zones[index]; }

 private:
  struct Contact {
    double after = -1;  // seconds after the element's start; negative: none
    Blocker blocker = Blocker::kZone;
    std::size_t index = 0;
  };

  void keep(Pieces pieces);
  RingShape ring_of(const Obstacle& o) const;
  Contact contact(const FlightElement& e, double leaf) const;
  double ground_contact(const FlightElement& e) const;
  double edge_contact(const FlightElement& e, const Box& box, double leaf) const;
  double depth_at(const Contact& c, const Vec3& p_N, double time) const;
  std::optional<Conflict> look(const FlightPlan& plan, double min_overlap,
                               bool words) const;
  Conflict in_words(const Contact& c, const FlightElement& e) const;

  PathQuery query_;
  std::vector<Obstacle> obstacles_;
  BoxForest forest_;
  std::vector<std::optional<geo::BoundaryIndex>> rings_;  // of zones with many corners
  std::vector<const PlannedFlight*> flights_;
  bool timed_ = false;
};

}  // namespace skein::solve
