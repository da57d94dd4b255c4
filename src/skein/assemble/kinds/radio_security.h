// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/assemble/kinds/contexts.h"
#include "skein/base/result.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/layer/communication/security/attack.h"
#include "skein/layer/communication/security/authenticity.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// Whom a flooder, a spoofer and a replayer are about, by name.
struct FlooderChoice {
  communication::Flooder flooder;
  std::string to;
};
struct SpooferChoice {
  communication::Spoofer spoofer;
  std::string as, to;
  Vec2 offset = Vec2::Zero();  ///< [m]
  double offset_up = 0;        ///< [m]
};
struct ReplayerChoice {
  communication::Replayer replayer;
  std::string of;
};

/// An attacker of the radio as a scenario describes it.
struct AttackChoice {
  std::string name;
  Vec2 position = Vec2::Zero();  ///< [m]
  double altitude_agl = 2;       ///< [m]
  double power_dbm = 20;
  Time from;
  std::optional<Time> until;
  std::optional<communication::Jammer> jammer;
  std::optional<FlooderChoice> flooder;
  std::optional<SpooferChoice> spoofer;
  std::optional<ReplayerChoice> replayer;
};

/// How a scenario has messages authenticated.
struct AuthenticationChoice {
  std::string key_file;
  bool required = true;
};

/// The authentication that a radio has; null: none.
const AuthenticationChoice* authentication_of(const scenario::Choice& radio);

scenario::Fields<AttackChoice> attack_fields();
scenario::Fields<AuthenticationChoice> authentication_fields();

/// Fails: kBadInput, at the key, for entities that there are not, packets that no frame
/// of the radio carries, and attacks that cannot do anything to it.
Result<std::vector<communication::Attack>> make_attacks(
    const std::vector<AttackChoice>& choices, const RadioContext& context,
    const communication::MacProfile& mac);

/// Fails: at the key, as mavlink::read_signing_key does.
Result<communication::AuthenticationOptions> make_authentication(
    const AuthenticationChoice& choice);

}  // namespace skein::assemble
