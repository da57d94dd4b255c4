// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_links/receiver_grid.h"
#include "skein/link/vehicle_links/traffic_message.h"

namespace skein::vehicle_links {

/// Which other aircraft a vehicle is told of.
struct TrafficOptions {
  double range = 5000;   ///< on the map [m]
  double rate = 2;       ///< of each of them [Hz]
  std::size_t max = 50;  ///< the nearest
};

/// Tells vehicles of one another: whoever says where it is, is shown at once to those
/// that are near.
///
/// Without clocks and I/O; called by one thread. An aircraft costs work for the receivers
/// in range, not for all. Of those in range a receiver is told of the nearest by what
/// they said last; each of them as often as its rate allows, on average. Who shares the
/// connection of a receiver is not shown there: ADSB_VEHICLE has no addressee, so it
/// would see itself.
class TrafficExchange {
 public:
  using Id = std::uint32_t;
  using Sink = std::function<void(Id receiver, const mavlink::AdsbVehicle&)>;

  struct Counts {
    std::uint64_t sent = 0;
    std::uint64_t limited = 0;  ///< left out: too soon, or too many in range
  };

  /// @param max_range  no receiver's is larger [m].
  /// @param sink       is given what is to be sent.
  TrafficExchange(const geo::LocalFrame& frame, double max_range, Sink sink)
      : frame_(frame), sink_(std::move(sink)), grid_(max_range) {}

  /// An aircraft, which may be a receiver too.
  /// @param name  no two have the same; callsign and ICAO address follow from it.
  /// @returns     its number, from 0.
  Id add(const std::string& name, bool is_simulated,
         const std::optional<TrafficOptions>& receives);

  /// It has said where it is. What is not finite is passed over.
  void moved(Id who, const TrafficState& state, Time now);

  /// It receives nothing any more, until it says again where it is.
  void lost(Id who);

  /// Of a receiver.
  const Counts& counts(Id who) const { return aircraft_[who].counts; }
  const TrafficIdentity& identity(Id who) const { return aircraft_[who].identity; }

 private:
  // What a receiver knows of another aircraft.
  struct Pair {
    Time due;             // not to be told of it before
    bool chosen = false;  // one of the nearest
  };
  struct Aircraft {
    TrafficIdentity identity;
    std::optional<TrafficOptions> receives;
    std::optional<TrafficState> state;
    Time heard;               // last
    std::vector<Pair> pairs;  // with each other one, by its number
    std::vector<Id> chosen;   // the nearest
    Counts counts;
  };

  bool takes(const Aircraft& receiver, const TrafficState& state, Time now) const;
  bool choose(Aircraft& receiver, Id who, Time now);
  double distance(const Aircraft& receiver, Id who, Time now) const;

  geo::LocalFrame frame_;
  Sink sink_;
  ReceiverGrid grid_;
  std::vector<Aircraft> aircraft_;
  std::set<std::uint32_t> addresses_;
};

}  // namespace skein::vehicle_links
