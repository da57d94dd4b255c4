// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "skein/assemble/radio/obstacle_fields.h"
#include "skein/assemble/radio/radio_parts.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/layer/communication/propagation/propagation_profile.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

// The sections of a radio file as they are written.

struct PhySection {
  communication::PhyProfile phy;  // without the error model
  scenario::Choice error_model{"dsss-2"};
  double preamble_header_us = 192;
  double lock_window_us = 4;
};

struct PropagationSection {
  scenario::Choice model{"free-space"};
  communication::PropagationProfile propagation;  // without the obstacles
  std::vector<ObstacleSection> obstacles;
};

struct MacSection {
  communication::MacProfile mac;
  double slot_us = 20, sifs_us = 10, difs_us = 50, eifs_us = 364, ack_timeout_us = 222;
  std::string backoff_slots = "random";   // or a number
  std::string queue_lifetime_s = "none";  // or a number
};

/// A word of `mac.access`.
struct AccessWord {
  const char* name;
  communication::AccessMethod method;
  const char* help;
};
inline constexpr std::array<AccessWord, 3> kAccessWords = {
    {{"dcf", communication::AccessMethod::kDcf,
      "carrier sense and back-off, as IEEE 802.11; half-duplex modems too"},
     {"tdma", communication::AccessMethod::kTdma, "a slot for each node, in turn"},
     {"direct", communication::AccessMethod::kDirect,
      "a line for each node, as by satellite or cell: nothing to share"}}};

scenario::Fields<PhySection> phy_fields();
scenario::Fields<PropagationSection> propagation_fields();
scenario::Fields<MacSection> mac_fields();

communication::PhyProfile phy_of(const PhySection& section);
PropagationChoice propagation_of(const PropagationSection& section);
communication::MacProfile mac_of(const MacSection& section);
ErrorModelContext error_model_context(const communication::PhyProfile& phy);
PhySection section_of(const communication::PhyProfile& phy,
                      const scenario::Choice& error_model);
PropagationSection section_of(const PropagationChoice& propagation);
MacSection section_of(const communication::MacProfile& mac);

}  // namespace skein::assemble
