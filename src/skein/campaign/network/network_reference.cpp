// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/network/network_reference.h"

namespace skein::campaign {
namespace {

constexpr GridReference kGrids[] = {
    // profile, RTS, nodes, mean and 95 % of delays, loss, goodput, CPU
    {"cs91", false, 2, 4.4477, 4.3863, 0, 80, 0.00021667},
    {"cs91", false, 4, 4.5783, 6.1212, 0, 160, 0.00095333},
    {"cs91", false, 9, 4.9616, 8.4004, 0, 360, 0.0039433},
    {"cs91", false, 16, 5.7175, 11.101, 0, 640, 0.010277},
    {"cs91", false, 25, 7.3683, 16.886, 0, 999.89, 0.02009},
    {"cs91", false, 36, 11.054, 27.666, 0, 1439.7, 0.033027},
    {"cs91", true, 2, 5.0028, 4.927, 0, 80, 0.0004},
    {"cs91", true, 4, 5.1636, 7.2352, 0, 160, 0.0018033},
    {"cs91", true, 9, 5.6485, 9.6014, 0, 360, 0.0081933},
    {"cs91", true, 16, 6.6424, 13.349, 0, 640, 0.021423},
    {"cs91", true, 25, 9.0199, 20.925, 0, 999.89, 0.039143},
    {"cs91", true, 36, 14.965, 37.832, 0, 1439.6, 0.06726},
    {"nn4", false, 2, 4.4477, 4.3863, 0, 80, 0.00022333},
    {"nn4", false, 4, 5.6828, 8.0017, 0.0013333, 159.79, 0.00079},
    {"nn4", false, 9, 7.0176, 22.632, 0.003654, 358.68, 0.0040167},
    {"nn4", false, 16, 7.969, 28.874, 0.005521, 636.44, 0.01027},
    {"nn4", false, 25, 9.2626, 35.849, 0.0095743, 990.32, 0.02306},
    {"nn4", false, 36, 10.943, 44.335, 0.018091, 1413.6, 0.044563},
    {"nn4", true, 2, 5.0028, 4.927, 0, 80, 0.00040667},
    {"nn4", true, 4, 5.1709, 7.2742, 0, 160, 0.0014667},
    {"nn4", true, 9, 5.6333, 9.4983, 2.4667e-05, 359.99, 0.0062333},
    {"nn4", true, 16, 5.9011, 10.286, 6.3e-05, 639.96, 0.018813},
    {"nn4", true, 25, 6.1026, 11.229, 0.00021333, 999.71, 0.03419},
    {"nn4", true, 36, 6.2847, 12.006, 0.00033933, 1439.3, 0.06214},
    {"nn8", false, 2, 4.4477, 4.3863, 0, 80, 0.00022667},
    {"nn8", false, 4, 4.5783, 6.1212, 0, 160, 0.00093},
    {"nn8", false, 9, 5.129, 9.0351, 0.000148, 359.95, 0.0040433},
    {"nn8", false, 16, 5.2515, 9.401, 4.2e-05, 639.97, 0.010717},
    {"nn8", false, 25, 5.4064, 9.8343, 0, 999.96, 0.015455},
    {"nn8", true, 2, 5.0028, 4.927, 0, 80, 0.00041333},
    {"nn8", true, 4, 5.1636, 7.2352, 0, 160, 0.0019233},
    {"nn8", true, 9, 5.562, 9.3587, 0, 360, 0.00757},
    {"nn8", true, 16, 5.7994, 9.9398, 0, 640, 0.021313},
    {"nn8", true, 25, 5.96, 10.297, 0, 1000, 0.03117},
};

constexpr CellReference kCells[] = {
    // RTS, stations, goodput, collisions, CPU
    {false, 2, 1611.8, 0.058933, 0.005133}, {false, 5, 1536.3, 0.17777, 0.01334},
    {false, 10, 1448, 0.2792, 0.02623},     {true, 2, 1488, 0.059, 0.008733},
    {true, 5, 1503.9, 0.1786, 0.02413},     {true, 10, 1504.8, 0.27977, 0.05108},
};

constexpr HiddenReference kHidden[] = {
    // profile, RTS, goodput, share delivered, CPU
    {"cs91", false, 1612.8, 1, 0.0063},       {"cs91", true, 1487.7, 1, 0.0108},
    {"nn4", false, 602.76, 0.82083, 0.00417}, {"nn4", true, 1424.8, 0.9925, 0.0111},
    {"nn8", false, 602.76, 0.82083, 0.00427}, {"nn8", true, 1424.8, 0.9925, 0.0109},
};

}  // namespace

std::optional<GridReference> grid_reference(std::string_view profile, bool rts,
                                            std::uint32_t nodes) {
  for (const GridReference& each : kGrids)
    if (each.profile == profile && each.rts == rts && each.nodes == nodes) return each;
  return std::nullopt;
}

std::optional<CellReference> cell_reference(bool rts, std::uint32_t stations) {
  for (const CellReference& each : kCells)
    if (each.rts == rts && each.stations == stations) return each;
  return std::nullopt;
}

std::optional<HiddenReference> hidden_reference(std::string_view profile, bool rts) {
  for (const HiddenReference& each : kHidden)
    if (each.profile == profile && each.rts == rts) return each;
  return std::nullopt;
}

}  // namespace skein::campaign
