// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "skein/assemble/kinds/kinds.h"
#include "skein/layer/communication/antenna/antenna_profile.h"
#include "skein/layer/communication/propagation/propagation_profile.h"
#include "skein/role/antenna.h"
#include "skein/role/error_model.h"
#include "skein/role/propagation.h"
#include "skein/role/terrain.h"
#include "skein/scenario/choice.h"

// The parts of a radio file that are kinds.

namespace skein::assemble {

/// What every propagation is given besides its options.
struct PropagationContext {
  std::uint64_t seed = 0;
  double frequency = 0;  ///< [Hz]
  /// The section of the radio file. Its obstacles are added to what is made.
  const communication::PropagationProfile& section;
  /// Of the run, outlives what is made; null: level ground at down = 0.
  const Terrain* ground = nullptr;
};

/// What every antenna is given besides its options.
struct AntennaContext {
  const communication::AntennaProfile& section;  ///< of the radio
};

/// What every error model is given besides its options.
struct ErrorModelContext {
  double rate = 0;             ///< of payloads [bit/s]
  double lock_ratio = 1;       ///< of `lock_sinr_db`
  double noise_bandwidth = 1;  ///< [Hz]
};

/// Implementations by role, one row each.
struct RadioParts {
  Kinds<Propagation, PropagationContext> propagation{"propagation"};
  Kinds<Antenna, AntennaContext> antenna{"antenna"};
  Kinds<ErrorModel, ErrorModelContext> error_model{"error-model"};
};

/// Skein's own.
RadioParts own_radio_parts();

/// What radio files are read with.
scenario::KindTable radio_table(const RadioParts& parts);

/// A propagation with the section of the radio file.
struct PropagationChoice {
  scenario::Choice model{"free-space"};
  communication::PropagationProfile section;
};

/// An antenna with the section of the radio.
struct AntennaChoice {
  scenario::Choice model{"isotropic"};
  communication::AntennaProfile section;
};

/// Signals on their way, by the obstacles of the section too.
/// @param frequency, seed, ground  PropagationContext
/// Fails: as the kind.
Result<std::unique_ptr<Propagation>> make_propagation(const RadioParts& parts,
                                                      const PropagationChoice& choice,
                                                      double frequency,
                                                      std::uint64_t seed,
                                                      const Terrain* ground = nullptr);

/// An antenna; null: alike in all directions.
/// Fails: as the kind.
Result<std::shared_ptr<const Antenna>> make_antenna(const RadioParts& parts,
                                                    const AntennaChoice& choice);

/// What is wrong with the rate of payloads for one of Skein's own error models, in words;
/// empty: nothing, or the model is another one.
std::string rate_violation(const scenario::Choice& error_model,
                           const ErrorModelContext& context);

}  // namespace skein::assemble
