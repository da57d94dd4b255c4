#include "skein/assemble/modem_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "skein/assemble/aircraft_builder.h"
#include "skein/assemble/common_ground.h"
#include "skein/assemble/ranges.h"
#include "skein/assemble/remote_kind.h"
#include "skein/link/world_link/entity_links.h"

namespace skein::assemble {
namespace {

std::string endpoint_error(const ModemChoice& choice) {
  const auto address = transport::parse_endpoint(choice.endpoint);
  return address ? std::string() : address.error().message;
}

std::string entities_error(const ModemChoice& choice) {
  return choice.entities.empty() ? "nobody is reached by the modem; name an aircraft."
                                 : std::string();
}

// Of what all must have in common, short enough to be said each second.
std::uint32_t fingerprint(const scenario::Scenario& scenario) {
  const std::string text = common_ground(scenario);
  std::uint32_t number = 0;
  std::from_chars(text.data(), text.data() + 8, number, 16);
  return number;
}

modem::ModemPeerOptions peer_options(const scenario::Scenario& scenario) {
  modem::ModemPeerOptions peer;
  peer.session = world_link::session_of_now();
  peer.scenario = fingerprint(scenario);
  peer.entities = scenario.stations.size();
  for (const auto& group : aircraft_names(scenario)) peer.entities += group.size();
  return peer;
}

Error bad_entity(const std::string& name, std::string why, std::string hint) {
  return {ErrorCode::kBadInput, "radio.modem.entities", fmt::format("{} {}", name, why),
          std::move(hint)};
}

}  // namespace

scenario::Fields<ModemChoice> modem_fields() {
  using T = ModemChoice;
  using modem::GatewayMethod;
  return scenario::Fields<T>()
      .text("endpoint", &T::endpoint,
            "Where the ground station's modem is: serial:DEVICE:BAUD, udpin:PORT...; see "
            "docs/links.md.")
      .integer("hw", &T::hw, "Address of this modem.",
               {.at_least = 1, .at_most = 0xFFFFFFFE})
      .text(
          "entities", &T::entities,
          "Aircraft of the vehicle `remote` whose messages go over modems of their own.")
      .word("gateway", &T::gateway,
            "How those behind the ground station's modem learn the way to others.",
            {{"fixed", GatewayMethod::kFixed, "they know others by their true addresses"},
             {"altering", GatewayMethod::kAltering,
              "the ground station passes others on under its own address"}})
      .duration_s("advertisement_period_s", &T::advertisement_period,
                  "Between its words who is reached through it, 10 % earlier or later; "
                  "after three without a word a neighbour is lost.",
                  {.at_least = 0.1, .at_most = 60})
      .boolean("pacing", &T::pacing,
               "What goes out waits until the modem can carry it (`rate_bps`).")
      .number("rate_bps", &T::rate, "What the modem can carry.",
              {.at_least = 100, .at_most = 1e9})
      .integer("queue", &T::queue, "Messages that may wait; more urgent ones go first.",
               {.at_least = 1, .at_most = 100'000})
      .duration_s("queue_lifetime_s", &T::queue_lifetime,
                  "What has waited longer is not sent.", {.above = 0, .at_most = 3600})
      .boolean("hear", &T::hear,
               "What the modem hears is on the air of the medium too, as from where its "
               "sender is; else it reaches all in range.")
      .boolean("inject", &T::inject,
               "Messages between simulated entities are sent by the modem too, so that "
               "real ones feel their load.")
      .rule("endpoint", endpoint_error)
      .rule("entities", entities_error);
}

Result<std::unique_ptr<modem::ModemLink>> make_world_modem(
    const scenario::Scenario& scenario) {
  const ModemChoice& choice = *modem_of(scenario.radio);
  modem::ModemLinkOptions options;
  options.endpoint = transport::parse_endpoint(choice.endpoint).value();
  options.peer = peer_options(scenario);
  options.peer.hw = choice.hw;
  options.peer.method = choice.gateway;
  options.peer.overhears = true;
  options.peer.advertisement_period = choice.advertisement_period;
  options.peer.queue = {choice.pacing ? choice.rate : 0, choice.queue,
                        choice.queue_lifetime};
  std::uint32_t entity = 0;
  for (; entity < scenario.stations.size(); ++entity)
    options.peer.identities.push_back(EntityId{entity});
  std::vector<std::string> missing = choice.entities;
  const auto names = aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g)
    for (const std::string& name : names[g]) {
      const auto found = std::find(missing.begin(), missing.end(), name);
      if (found == missing.end())
        options.peer.identities.push_back(EntityId{entity});
      else if (scenario.aircraft[g].vehicle.kind != kRemoteKind)
        return bad_entity(name, "has its agent in this program.",
                          "Give its group the vehicle {kind: remote}.");
      else
        missing.erase(found);
      ++entity;
    }
  if (!missing.empty())
    return bad_entity(missing.front(), "is no aircraft of the scenario, or named twice.",
                      "They are called GROUP-1, GROUP-2...");
  return std::make_unique<modem::ModemLink>(std::move(options));
}

std::unique_ptr<modem::ModemLink> make_agent_modem(const scenario::Scenario& scenario,
                                                   EntityId self,
                                                   const AgentModem& modem) {
  modem::ModemLinkOptions options;
  options.endpoint = modem.endpoint;
  options.peer = peer_options(scenario);
  options.peer.hw = modem.hw != 0 ? modem.hw : self.value + 1;
  options.peer.identities = {self};
  options.peer.queue.rate = modem.rate;
  if (const ModemChoice* choice = modem_of(scenario.radio))
    options.peer.advertisement_period = choice->advertisement_period;
  return std::make_unique<modem::ModemLink>(std::move(options));
}

}  // namespace skein::assemble
