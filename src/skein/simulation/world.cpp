// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/world.h"

#include <utility>

#include "skein/role/agent.h"
#include "skein/role/moving_object.h"
#include "skein/role/phenomenon.h"
#include "skein/role/radio.h"
#include "skein/role/terrain.h"
#include "skein/role/traffic_aircraft.h"
#include "skein/role/vehicle.h"
#include "skein/role/world_memory.h"
#include "skein/simulation/commanded_wind.h"

namespace skein::simulation {

// Here, so that who includes world.h need not know the roles.
Entity::Entity() = default;
Entity::Entity(Entity&&) noexcept = default;
Entity& Entity::operator=(Entity&&) noexcept = default;
Entity::~Entity() = default;

WorldObject::WorldObject(GroundObject what, std::unique_ptr<MovingObject> moved)
    : object(std::move(what)), movement(std::move(moved)) {}
WorldObject::WorldObject(WorldObject&&) noexcept = default;
WorldObject& WorldObject::operator=(WorldObject&&) noexcept = default;
WorldObject::~WorldObject() = default;

WorldTraffic::WorldTraffic(AirTraffic who, std::unique_ptr<TrafficAircraft> flown)
    : what(std::move(who)), aircraft(std::move(flown)) {}
WorldTraffic::WorldTraffic(WorldTraffic&&) noexcept = default;
WorldTraffic& WorldTraffic::operator=(WorldTraffic&&) noexcept = default;
WorldTraffic::~WorldTraffic() = default;

World::World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

}  // namespace skein::simulation
