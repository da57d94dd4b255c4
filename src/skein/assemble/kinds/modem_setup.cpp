// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/modem_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "skein/assemble/kinds/radio_security.h"
#include "skein/assemble/kinds/ranges.h"
#include "skein/assemble/kinds/remote_kind.h"
#include "skein/assemble/world/aircraft_builder.h"
#include "skein/assemble/world/common_ground.h"
#include "skein/layer/communication/security/seal.h"
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

// What a line carries [bit/s], of whose ten bits eight are the byte; 0: it is no line,
// and nobody knows.
double line_rate(const transport::EndpointAddress& address) {
  const auto* line = std::get_if<transport::SerialLine>(&address);
  return line ? 0.8 * line->baud : 0;
}

// What is wrong with a rate for a modem at an endpoint; empty: nothing.
std::string rate_error_at(const transport::EndpointAddress& address, double rate) {
  const double most = line_rate(address);
  if (most == 0 || rate <= most) return {};
  return fmt::format("{} is more than the {} bit/s that {} carries.", rate, most,
                     transport::text_of(address));
}

std::string rate_error(const ModemChoice& choice) {
  const auto address = transport::parse_endpoint(choice.endpoint);
  if (!address || !choice.pacing) return {};
  return rate_error_at(address.value(), choice.rate);
}

std::uint32_t default_hw(EntityId entity) {
  return entity.value + 1;
}

modem::DatagramSeal seal_of(const communication::AuthenticationOptions& options) {
  const auto seal = std::make_shared<const communication::Seal>(options.key);
  return {communication::Seal::kBytes,
          [seal](std::vector<std::byte>& datagram, std::uint64_t number) {
            seal->put_on(datagram, number);
          },
          [seal](std::span<const std::byte> sealed) {
            return seal->counter_of(sealed).has_value();
          },
          options.required};
}

// How the datagrams of a modem are sealed; null: the radio does not authenticate.
Result<std::optional<modem::DatagramSeal>> make_seal(const AuthenticationChoice* choice) {
  if (!choice) return std::optional<modem::DatagramSeal>();
  const auto options = make_authentication(*choice);
  if (!options) return options.error();
  return std::optional(seal_of(options.value()));
}

// The same for an agent, whose key may be in another file.
Result<std::optional<modem::DatagramSeal>> make_agent_seal(const scenario::Choice& radio,
                                                           const std::string& key_file) {
  const AuthenticationChoice* of_scenario = authentication_of(radio);
  if (key_file.empty()) return make_seal(of_scenario);
  AuthenticationChoice own;
  if (of_scenario) own = *of_scenario;
  own.key_file = key_file;
  auto made = make_seal(&own);
  if (made) return made;
  Error error = made.error();
  error.place = "--key";
  return error;
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

Error same_address(const std::string& name, std::uint32_t hw) {
  return {ErrorCode::kBadInput, "radio.modem.hw",
          fmt::format("{} is the address of the modem of {} too: its number and 1.", hw,
                      name),
          "Take another one: modems with the same address do not hear each other."};
}

// Appends who is reached through the ground station's modem of the aircraft.
Result<void> find_beyond(const scenario::Scenario& scenario, const ModemChoice& choice,
                         std::vector<EntityId>& here) {
  std::vector<std::string> missing = choice.entities;
  EntityId entity{static_cast<std::uint32_t>(scenario.stations.size())};
  const auto names = aircraft_names(scenario);
  for (std::size_t g = 0; g < names.size(); ++g)
    for (const std::string& name : names[g]) {
      const auto found = std::find(missing.begin(), missing.end(), name);
      if (found == missing.end())
        here.push_back(entity);
      else if (scenario.aircraft[g].vehicle.kind != kRemoteKind)
        return bad_entity(name, "has its agent in this program.",
                          "Give its group the vehicle {kind: remote}.");
      else if (default_hw(entity) == choice.hw)
        return same_address(name, choice.hw);
      else
        missing.erase(found);
      ++entity.value;
    }
  if (!missing.empty())
    return bad_entity(missing.front(), "is no aircraft of the scenario, or named twice.",
                      "They are called GROUP-1, GROUP-2...");
  return {};
}

}  // namespace

scenario::Fields<ModemChoice> modem_fields() {
  using T = ModemChoice;
  return scenario::Fields<T>()
      .text("endpoint", &T::endpoint,
            "Where the ground station's modem is: serial:DEVICE:BAUD, udpin:PORT...; see "
            "docs/links.md.")
      .integer("hw", &T::hw, "Address of this modem.",
               {.at_least = 1, .at_most = 0xFFFFFFFE})
      .text(
          "entities", &T::entities,
          "Aircraft of the vehicle `remote` whose messages go over modems of their own.")
      .word("gateway", &T::gateway, "How simulated entities reach these.",
            {{"fixed", GatewayMethod::kFixed,
              "by their own addresses: in the medium they are where they are"},
             {"altering", GatewayMethod::kAltering,
              "by the address of the first ground station, which puts it into what they "
              "say: in the medium they are where it is"}})
      .duration_s("advertisement_period_s", &T::advertisement_period,
                  "Between its words who is reached through it, 10 % earlier or later; "
                  "after three without a word a neighbour is lost.",
                  {.at_least = 0.1, .at_most = 60})
      .boolean("pacing", &T::pacing,
               "What goes out waits until the modem can carry it (`rate_bps`).")
      .number("rate_bps", &T::rate,
              "What the modem can carry; not more than a serial line does: 8 of 10 bits.",
              {.at_least = 100, .at_most = 1e9})
      .integer("queue", &T::queue, "Messages that may wait; more urgent ones go first.",
               {.at_least = 1, .at_most = 100'000})
      .duration_s("queue_lifetime_s", &T::queue_lifetime,
                  "What has waited longer is not sent.", {.above = 0, .at_most = 3600})
      .boolean(
          "receive", &T::receive,
          "Messages that the modem receives are on the air of the medium too, as from "
          "where their sender is; else they reach all in range.")
      .formerly("hear")
      .boolean("inject", &T::inject,
               "Messages between simulated entities are sent by the modem too, so that "
               "real ones feel their load.")
      .rule("endpoint", endpoint_error)
      .rule("entities", entities_error)
      .rule("rate_bps", rate_error);
}

Result<std::unique_ptr<modem::ModemLink>> make_world_modem(
    const scenario::Scenario& scenario) {
  const ModemChoice& choice = *modem_of(scenario.radio);
  modem::ModemLinkOptions options;
  options.endpoint = transport::parse_endpoint(choice.endpoint).value();
  options.peer = peer_options(scenario);
  options.peer.hw = choice.hw;
  options.peer.overhears = true;
  options.peer.advertisement_period = choice.advertisement_period;
  options.peer.queue = {choice.pacing ? choice.rate : 0, choice.queue,
                        choice.queue_lifetime};
  for (std::uint32_t k = 0; k < scenario.stations.size(); ++k)
    options.peer.identities.push_back(EntityId{k});
  if (auto found = find_beyond(scenario, choice, options.peer.identities); !found)
    return found.error();
  auto seal = make_seal(authentication_of(scenario.radio));
  if (!seal) return seal.error();
  options.peer.seal = std::move(seal).value();
  return std::make_unique<modem::ModemLink>(std::move(options));
}

Result<std::unique_ptr<modem::ModemLink>> make_agent_modem(
    const scenario::Scenario& scenario, EntityId self, const AgentModem& modem) {
  modem::ModemLinkOptions options;
  options.endpoint = modem.endpoint;
  options.peer = peer_options(scenario);
  options.peer.hw = modem.hw != 0 ? modem.hw : default_hw(self);
  options.peer.identities = {self};
  if (auto error = rate_error_at(modem.endpoint, modem.rate); !error.empty())
    return Error{ErrorCode::kBadInput, "--modem-rate", std::move(error), ""};
  options.peer.queue.rate = modem.rate > 0 ? modem.rate : line_rate(modem.endpoint);
  if (const ModemChoice* choice = modem_of(scenario.radio)) {
    if (choice->hw == options.peer.hw)
      return Error{ErrorCode::kBadInput, "--hw",
                   fmt::format("{} is the address of the ground station's modem.",
                               options.peer.hw),
                   "Modems with the same address do not hear each other."};
    options.peer.advertisement_period = choice->advertisement_period;
  }
  auto seal = make_agent_seal(scenario.radio, modem.key_file);
  if (!seal) return seal.error();
  options.peer.seal = std::move(seal).value();
  return std::make_unique<modem::ModemLink>(std::move(options));
}

}  // namespace skein::assemble
