// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/mission_items.h"
#include "skein/link/vehicle_services/mission_service.h"
#include "skein/link/vehicle_services/served_vehicle.h"

namespace skein::vehicle_services {

/// A vehicle's mission, fence and rally points, as ground stations load them up and down.
/// A mission that is found good goes to the simulation; a fence is kept with the vehicle;
/// rally points are kept, and have no effect.
class StoredLists {
 public:
  /// @param vehicle  outlives this.
  explicit StoredLists(ServedVehicle& vehicle);
  StoredLists(const StoredLists&) = delete;
  StoredLists& operator=(const StoredLists&) = delete;

  /// What a ground station says of a list; each keeps to those of its type.
  template <class Message>
  void handle(const Message& message, const Peer& from, Outbox& out) {
    for (MissionService* list : {&mission_, &fence_, &rally_})
      list->handle(message, from, out);
  }
  void handle(const mavlink::MissionCount& count, const Peer& from, Outbox& out);
  void handle(const mavlink::MissionItemInt& item, const Peer& from, Outbox& out);
  void handle(const mavlink::MissionItem& item, const Peer& from, Outbox& out);
  void handle(const mavlink::MissionClearAll& order, const Peer& from, Outbox& out);
  /// Parts of a list are not replaced.
  void handle(const mavlink::MissionWritePartialList& request, const Peer& from,
              Outbox& out);

  void step(Outbox& out);
  void close(Channel channel);
  /// Home may have moved: it is the first item with some makes.
  void update_home();

 private:
  mavlink::MissionResult take_mission(const std::vector<mavlink::MissionItemInt>& list);
  mavlink::MissionResult take_fence(const std::vector<mavlink::MissionItemInt>& list);
  mavlink::MissionResult take_rally(const std::vector<mavlink::MissionItemInt>& list);
  mavlink::MissionResult report(const ListVerdict& verdict);
  void acknowledge(mavlink::MissionResult result, std::uint8_t type, const Peer& to,
                   Outbox& out) const;

  ServedVehicle& vehicle_;
  MissionService mission_, fence_, rally_;
  std::optional<Vec3> home_N_;  // that the mission begins with
};

}  // namespace skein::vehicle_services
