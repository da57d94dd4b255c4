#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/assemble/radio/obstacle_fields.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/layer/communication/propagation/propagation_profile.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

// The sections of a radio file as they are written.

struct PhySection {
  communication::PhyProfile phy;
  double preamble_header_us = 192;
  double lock_window_us = 4;
};

struct PropagationSection {
  communication::PropagationProfile propagation;  // without the obstacles
  std::vector<ObstacleSection> obstacles;
};

struct MacSection {
  communication::MacProfile mac;
  double slot_us = 20, sifs_us = 10, difs_us = 50, eifs_us = 364, ack_timeout_us = 222;
  std::string backoff_slots = "random";   // or a number
  std::string queue_lifetime_s = "none";  // or a number
};

scenario::Fields<PhySection> phy_fields();
scenario::Fields<PropagationSection> propagation_fields();
scenario::Fields<MacSection> mac_fields();

communication::PhyProfile phy_of(const PhySection& section);
communication::PropagationProfile propagation_of(const PropagationSection& section);
communication::MacProfile mac_of(const MacSection& section);
PhySection section_of(const communication::PhyProfile& phy);
PropagationSection section_of(const communication::PropagationProfile& propagation);
MacSection section_of(const communication::MacProfile& mac);

}  // namespace skein::assemble
