// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/radio/message.h"
#include "skein/data/team/task.h"
#include "skein/data/traffic/separation.h"
#include "skein/data/traffic/separation_loss.h"
#include "skein/geo/vec.h"

namespace skein::simulation {

/// Watches by the truth, whatever aircraft do and know, how near they come to each other.
///
/// A pair has to keep
///
///   in the air    the larger of both separations: what each says in its plans that it
///                 keeps, 50 m or 20 m until it has said so
///   in formation  5 m or 5 m: how far apart its members fly is the formation's to say
///   on the ground 5 m or 5 m, while one of both moves
///
/// and loses separation when the larger ratio of distance to that, horizontal or
/// vertical, is below 1. Between two moments both move straight. An encounter is over
/// when the ratio has been 1.1 or more for ten seconds, so that one encounter is one
/// loss.
///
/// Cost: a grid as wide as what is kept: N log N a moment for N aircraft, and what is
/// nearer than that. No allocation but where there are more neighbours, or more pairs too
/// near at once, than ever before.
class SeparationMonitor {
 public:
  /// What members of a formation, and aircraft on the ground, keep.
  static constexpr Separation kCollision{5, 5};

  /// @param entities  their number.
  explicit SeparationMonitor(std::size_t entities);

  /// What an aircraft has sent: the separation that it keeps, and the orders that make it
  /// a member of a formation.
  void listen(const Message& message);

  /// Where an aircraft is now. Of who has no place in a moment the encounters are over.
  void place(EntityId id, const Vec3& p_N, const Vec3& v_N, bool on_ground);

  /// All who take part have their place: looks at what they flew since the last moment.
  void look(Time now);

  /// The run ends: what goes on is over.
  void finish(Time now);

  /// Whether an aircraft has said that it keeps apart from others.
  bool keeps_apart(EntityId id) const {
    return id.value < aircraft_.size() && aircraft_[id.value].keeps_apart;
  }

  /// Encounters that began with the last look(): as they were then.
  std::span<const SeparationLossRecord> begun() const { return begun_; }
  /// Encounters that were over with the last look() or finish().
  std::span<const SeparationLossRecord> over() const { return over_; }

 private:
  struct Aircraft {
    Separation kept;
    bool keeps_apart = false;        // it has said so
    std::optional<EntityId> leader;  // of its formation
    Vec3 p_N = Vec3::Zero(), before = Vec3::Zero();
    double speed = 0;  // [m/s]
    Time touched;      // the ground last
    bool on_ground = false, has_touched = false;
    bool is_there = false, was_there = false;
  };
  struct Cell {
    std::uint64_t key = 0;
    std::uint32_t aircraft = 0;
  };
  struct Encounter {
    SeparationLossRecord loss;
    Time apart_since;
    bool is_apart = false, is_over = false;
  };
  struct Closest {
    double ratio = 0, horizontal = 0, vertical = 0, distance = 0, share = 1;
  };
  void sort_into_cells(Time now);
  void look_at_neighbours(std::size_t k, Time now);
  void look(std::uint32_t a, std::uint32_t b, Time now);
  void take(const SeparationLossRecord& moment, Time now);
  void end_encounters(Time now);
  SeparationPhase phase(const Aircraft& a, const Aircraft& b) const;
  bool in_formation(const Aircraft& a, const Aircraft& b) const;
  EntityId first_leader(EntityId id) const;
  static bool stays_beside(const Aircraft& a, const Aircraft& b, double distance);
  static Closest closest(const Aircraft& a, const Aircraft& b, const Separation& kept);

  std::vector<Aircraft> aircraft_;      // by their numbers
  std::vector<std::uint32_t> present_;  // that have their place now
  std::vector<Cell> cells_;             // sorted
  std::vector<Encounter> encounters_;   // that go on, by pair
  std::size_t known_ = 0;               // of them, before this look
  std::vector<SeparationLossRecord> begun_, over_;
  double moved_ = 0;  // by two towards each other since the last moment, at most [m]
  Time looked_;
};

}  // namespace skein::simulation
