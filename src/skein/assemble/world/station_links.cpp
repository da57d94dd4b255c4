// SPDX-License-Identifier: Apache-2.0
// Where ground stations outside are met, and who is shown there: all that is simulated.
#include <fmt/format.h>

#include <optional>
#include <utility>

#include "skein/assemble/world/world_draft.h"
#include "skein/link/mavlink/signing_key_file.h"
#include "skein/link/transport/endpoint_address.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/link/vehicle_links/vehicle_links.h"
#include "skein/scenario/utc.h"
#include "skein/simulation/simulated_vehicle.h"

namespace skein::assemble {
namespace {

using scenario::AircraftGroup;

std::optional<mavlink::UnsignedFrames> unsigned_frames(
    scenario::StationLink::Unsigned what) {
  using What = scenario::StationLink::Unsigned;
  if (what == What::kAll) return mavlink::UnsignedFrames::kAll;
  if (what == What::kTelemetry) return mavlink::UnsignedFrames::kTelemetry;
  return std::nullopt;
}

// Simulated aircraft, to ground stations and to real vehicles.
void show_aircraft(WorldDraft& draft, bool to_stations) {
  std::vector<vehicle_links::ShownAircraft> all;
  std::vector<std::string> traffic;
  std::size_t entity = draft.scenario.stations.size();
  for (const AircraftGroup& group : draft.scenario.aircraft)
    for (int i = 0; i < group.count && entity < draft.build.world.entities.size();
         ++i, ++entity) {
      const simulation::Entity& aircraft = draft.build.world.entities[entity];
      if (group.vehicle.kind != "simulated") continue;
      if (draft.build.links->needs_traffic()) traffic.push_back(aircraft.name);
      if (!to_stations) continue;
      const FlightLimits limits = parts_of(aircraft).plant->limits();
      vehicle_services::VehicleServerOptions server;
      server.system = static_cast<std::uint8_t>(draft.scenario.links.first_system);
      server.make = draft.scenario.links.autopilot == scenario::ShownAs::kPx4
                        ? vehicle_services::Make::kPx4
                        : vehicle_services::Make::kArduPilot;
      server.hovers = limits.slowest == 0;
      server.limits = limits;
      server.name = aircraft.name;
      server.software = "Skein";
      server.seed = draft.scenario.seed;
      server.index = static_cast<std::uint32_t>(all.size());
      if (const auto start = scenario::parse_utc(draft.scenario.start_utc))
        server.start_unix_us = *start * 1'000'000;
      vehicle_links::ShownAircraft shown;
      shown.name = aircraft.name;
      shown.hovers = server.hovers;
      shown.ardupilot = server.make == vehicle_services::Make::kArduPilot;
      shown.commanded = group.agent.kind == "commanded";
      shown.server = draft.build.links->show(std::move(server));
      all.push_back(std::move(shown));
    }
  if (to_stations || !all.empty() || !traffic.empty())
    draft.build.feed = std::make_unique<vehicle_links::VehicleFeed>(
        *draft.build.links, std::move(all), traffic);
}

}  // namespace

void make_station_links(WorldDraft& draft) {
  const scenario::Links& links = draft.scenario.links;
  for (const scenario::StationLink& link : links.ground_stations) {
    const auto address = transport::parse_endpoint(link.endpoint);
    if (!draft.note(address)) continue;
    draft.build.links->add_station(
        {address.value(), link.is_signed, unsigned_frames(link.unsigned_frames)});
    if (!link.is_signed &&
        link.unsigned_frames == scenario::StationLink::Unsigned::kAll &&
        !transport::is_local(address.value()))
      draft.build.warnings.push_back(
          fmt::format("links.ground_stations: whoever reaches {} may command all "
                      "aircraft that are shown there: frames are not signed.",
                      link.endpoint));
  }
  show_aircraft(draft, !links.ground_stations.empty());
  if (!links.key_file.empty()) {
    const auto key = mavlink::read_signing_key(links.key_file);
    if (draft.note(key)) draft.build.links->set_key(key.value());
  } else if (draft.build.links->needs_key()) {
    draft.errors.push_back({ErrorCode::kBadInput, "links.key_file",
                            "is needed: a link is signed.",
                            "Give a file that only you can read."});
  }
}

}  // namespace skein::assemble
