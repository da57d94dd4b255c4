// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace skein::campaign {

// What a packet-level simulator, ns-3.37, made of the same networks: means over one to
// three seeds. Its retry rule was replaced by the standard's, which gives up on failed
// RTS.

/// Nodes on a grid, as in [Selecky18] 6.4.3.
struct GridReference {
  std::string_view profile;
  bool rts = false;
  std::uint32_t nodes = 0;
  double delay_mean_ms = 0, delay_p95_ms = 0;
  double loss = 0;  ///< share
  double goodput_kbps = 0;
  double cpu = 0;  ///< CPU seconds per simulated second, start-up not counted
};

/// Stations in one cell that always have something to send.
struct CellReference {
  bool rts = false;
  std::uint32_t stations = 0;
  double goodput_kbps = 0;
  double collisions = 0;  ///< share of transmissions that collide
  double cpu = 0;         ///< CPU seconds per simulated second
};

/// Two stations that do not hear each other and send to one between them.
struct HiddenReference {
  std::string_view profile;
  bool rts = false;
  double goodput_kbps = 0;
  double delivered = 0;  ///< share
  double cpu = 0;        ///< CPU seconds per simulated second
};

/// None where there is no reference.
std::optional<GridReference> grid_reference(std::string_view profile, bool rts,
                                            std::uint32_t nodes);
std::optional<CellReference> cell_reference(bool rts, std::uint32_t stations);
std::optional<HiddenReference> hidden_reference(std::string_view profile, bool rts);

}  // namespace skein::campaign
