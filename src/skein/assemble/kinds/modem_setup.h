// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/link/modem/modem_link.h"
#include "skein/scenario/fields.h"
#include "skein/scenario/scenario.h"

namespace skein::assemble {

/// How simulated entities reach those beyond the ground station's modem.
enum class GatewayMethod {
  kFixed,    ///< by their own addresses: they have places of their own in the medium
  kAltering  ///< by that of the ground station, which says that it is them
};

/// A real modem in the radio medium of a scenario.
struct ModemChoice {
  std::string endpoint = "udpin:14900";
  std::uint32_t hw = 1;
  std::vector<std::string> entities;  ///< who is reached through others
  GatewayMethod gateway = GatewayMethod::kFixed;
  Time advertisement_period = Time::from_seconds(1);
  bool pacing = true;
  double rate = 100'000;  ///< [bit/s]
  std::size_t queue = 100;
  Time queue_lifetime = Time::from_seconds(5);
  bool receive = true;
  bool inject = false;
};

/// Its keys.
scenario::Fields<ModemChoice> modem_fields();

/// The modem that a radio has; null: none.
const ModemChoice* modem_of(const scenario::Choice& radio);

/// The ground station's modem, through which all that is simulated is reached. The
/// scenario's radio has one. Where the radio authenticates messages it does so too.
/// Fails: kBadInput for entities that are no aircraft of the kind `remote`, or whose
/// modem has the address of this one; for the key, as make_authentication() does.
Result<std::unique_ptr<modem::ModemLink>> make_world_modem(
    const scenario::Scenario& scenario);

/// An agent's own modem, and where it is.
struct AgentModem {
  transport::EndpointAddress endpoint;
  std::uint32_t hw = 0;  ///< 0: the number of the entity, and 1
  double rate = 0;  ///< that it can carry [bit/s]; 0: what a serial line carries, and
                    ///< of others no limit
  std::string key_file = {};  ///< of the team; empty: that of the scenario, if it has one
};

/// The modem of an entity in a program of its own.
/// Fails: kBadInput for the address of the ground station's modem, and a rate that the
/// line does not carry; for the key, as make_authentication() does.
Result<std::unique_ptr<modem::ModemLink>> make_agent_modem(
    const scenario::Scenario& scenario, EntityId self, const AgentModem& modem);

}  // namespace skein::assemble
