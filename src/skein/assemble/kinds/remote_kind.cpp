// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/remote_kind.h"

#include <memory>
#include <string>
#include <utility>

#include "skein/assemble/kinds/vehicle_context.h"
#include "skein/link/modem/modem_parts.h"
#include "skein/link/world_link/entity_links.h"
#include "skein/mixed/remote_entity.h"

namespace skein::assemble {
namespace {

// An entity whose vehicle and agent are both in another program: `skein agent`.
struct RemoteOptions {
  std::string listen = "udpin:14700";
  Time silence = Time::from_seconds(2);
  Time max_age = Time::from_seconds(5);
};

std::string listen_error(const RemoteOptions& options) {
  const auto address = transport::parse_endpoint(options.listen);
  if (!address) return address.error().message;
  return world_link::carries_packets(address.value())
             ? std::string()
             : "agents are met by UDP or TCP only.";
}

scenario::Fields<RemoteOptions> remote_fields() {
  using T = RemoteOptions;
  return scenario::Fields<T>()
      .text("listen", &T::listen,
            "Where its agent is met: udpin:PORT, tcpin:PORT...; see docs/links.md. "
            "Several entities may share it.")
      .duration_s("silence_s", &T::silence, "Its link is down when it is silent so long.",
                  {.at_least = 0.5, .at_most = 60})
      .duration_s("max_age_s", &T::max_age,
                  "Its sensors see nothing when its last state is older.",
                  {.at_least = 0.5, .at_most = 60})
      .rule("listen", listen_error);
}

bool by_modem(const VehicleContext& c) {
  return c.modem && c.modem->is_beyond(c.aircraft.self);
}

Result<std::unique_ptr<EntityPort>> remote_port(const RemoteOptions& options,
                                                const VehicleContext& c) {
  if (c.recorded)
    return std::unique_ptr<EntityPort>(
        std::make_unique<mixed::RecordedEntityPort>(*c.recorded));
  const auto number = c.remotes.add(
      {c.parts.name, transport::parse_endpoint(options.listen).value(), options.silence});
  if (!number) return number.error();
  auto port = c.remotes.port(number.value());
  if (!by_modem(c)) return port;
  return std::unique_ptr<EntityPort>(
      std::make_unique<modem::ModemPort>(std::move(port), *c.modem, c.aircraft.self));
}

Result<std::unique_ptr<Vehicle>> make_remote(const RemoteOptions& options,
                                             const VehicleContext& c) {
  auto port = remote_port(options, c);
  if (!port) return port.error();
  mixed::RemoteEntityParts parts;
  parts.name = c.parts.name;
  parts.self = c.aircraft.self;
  parts.port = std::move(port).value();
  parts.payload = std::move(c.parts.payload);
  parts.hovers = c.aircraft.limits.slowest == 0;
  parts.start = c.aircraft.initial;
  parts.max_age = options.max_age;
  parts.by_modem = by_modem(c);
  auto vehicle = std::make_unique<mixed::RemoteVehicle>(std::move(parts));
  c.agent = vehicle->agent();
  return std::unique_ptr<Vehicle>(std::move(vehicle));
}

}  // namespace

void add_remote_kind(Kinds<Vehicle, VehicleContext>& kinds) {
  kinds.add(std::string(kRemoteKind),
            "An aircraft whose agent is in another program too (skein agent). Of its "
            "parts here the payload looks at the virtual world.",
            remote_fields(), [](const RemoteOptions& o, const VehicleContext& c) {
              return make_remote(o, c);
            });
}

}  // namespace skein::assemble
