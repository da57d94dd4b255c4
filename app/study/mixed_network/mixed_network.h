// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "app/study/mixed_network/modem_air.h"
#include "skein/link/modem/modem_link.h"

namespace skein::mixed_network {

/// What carries messages between simulated entities.
enum class SimulatedAir {
  kMedium,  ///< the medium, and the station's modem is paced to what its radio carries
  kIdeal,   ///< all hear all at once
};

struct MixedNetworkOptions {
  assemble::RadioFile radio;  ///< of all modems, real and simulated
  std::vector<Vec3> places;   ///< of the entities, in N [m]
  std::vector<bool> real;     ///< by entity: has a modem of its own
  Vec3 station;               ///< place of the modem of the others
  /// Real ones that are out of reach of each other: they need not meet.
  std::vector<std::pair<EntityId, EntityId>> apart;
  SimulatedAir simulated = SimulatedAir::kMedium;
  std::uint64_t seed = 1;
};

/// Entities that stand still and say things to all, in real time: the real ones each
/// behind a socket of its own at a stand-in of the air, the others in a ground station
/// with one modem there. The station puts what it hears on the medium of the simulated
/// ones, which decides who of them hears it, and sends what real ones are to hear of
/// these.
///
/// Threads: one caller.
class MixedNetwork {
 public:
  /// An arrival of what `from` has said at `to`.
  struct Arrival {
    EntityId from, to;
  };

  explicit MixedNetwork(MixedNetworkOptions options);

  /// Opens all sockets and waits until all have met.
  /// Fails: kUnavailable where they do not; kInterrupted when stopped.
  Result<void> start(const std::atomic<bool>& stop);

  /// Time since it was made.
  Time now() const;

  /// `entity` says so many bytes to all others.
  void say(EntityId entity, std::size_t bytes);

  /// Does what is due, and rests a moment; appends what has arrived.
  void step(std::vector<Arrival>& arrivals);

  /// Of the ground station's modem; empty where all are real.
  modem::ModemStatistics station() const;

 private:
  Result<void> open(const transport::EndpointAddress& air,
                    std::vector<EntityId> identities);
  std::size_t meetings() const;
  bool is_real(EntityId entity) const { return options_.real[entity.value]; }

  MixedNetworkOptions options_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::vector<EntityId> real_, simulated_;
  std::unique_ptr<ModemAir> air_;
  std::vector<std::unique_ptr<modem::ModemLink>> modems_;  // of real_, then the station's
  std::unique_ptr<Radio> medium_;                          // null: all are real
  std::uint64_t number_ = 0;
  RadioNews news_;
};

}  // namespace skein::mixed_network
