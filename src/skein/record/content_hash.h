#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/hash.h"
#include "skein/role/recorder.h"

namespace skein::record {

/// The fingerprint of everything a recorder is given, in the order of the calls. Numbers
/// count by value; nothing of the machine, the wall clock or the way of storing enters.
/// One function for each of Recorder's.
class ContentHash {
 public:
  void entity(EntityId id, const std::string& name, const std::string& kind);
  void truth(Time time, EntityId id, const VehicleState& state);
  void estimate(EntityId id, const NavEstimate& estimate, const AutopilotStatus& status);
  void reading(const FireReading& reading);
  void message(const Message& message, Time arrived, bool lost);
  void perimeter(Time time, const geo::Region& truth, EntityId believer,
                 const BoundaryEstimate& belief);
  void event(const Event& event);
  void crossing(const Crossing& crossing);
  void zone(Time time, const ZoneChange& change);
  void object(const GroundObject& object);
  void detection(const Detection& detection);
  void footprint(const Footprint& footprint);
  void ranges(const RangeScan& scan);

  /// The fingerprint of all so far: 32 hexadecimal digits.
  std::string hex() const { return hasher_.hex(); }

 private:
  void put(double number);
  void put(std::uint64_t number) { buffer_.push_back(number); }
  void put(Time time) { put(static_cast<std::uint64_t>(time.ns())); }
  void put(EntityId id) { put(std::uint64_t{id.value}); }
  void put(bool flag) { put(std::uint64_t{flag}); }
  void put(const Vec2& v);
  void put(const Vec3& v);
  void put(const NavEstimate& estimate);
  void put(const FireReading& reading);
  void put(const AircraftReport& report);
  void put(const Task& task);
  void put(const SignOfLife&) {}
  void put(const TeamPosition& position);
  void put(const ZoneChange& change);
  void put(const std::vector<Vec2>& points);
  void put(std::string_view text);
  void begin(std::uint64_t kind);
  void end();

  Hasher hasher_;
  std::vector<std::uint64_t> buffer_;  // one record; hashing many small pieces is slow
};

}  // namespace skein::record
