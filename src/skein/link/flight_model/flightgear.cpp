// SPDX-License-Identifier: Apache-2.0
#include "skein/link/flight_model/flightgear.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skein::flight_model {
namespace {

constexpr double kFoot = 0.3048;  // [m]
constexpr std::string_view kMark =
    "skein-1";  // begins each line; its number is the form's

// A property of FlightGear's and how it is written.
struct Property {
  const char* node;
  const char* type;
  const char* format;
};

enum Out : std::size_t {
  kTime,
  kLatitude,
  kLongitude,
  kAltitude,
  kRoll,
  kPitch,
  kHeading,
  kRollRate,
  kPitchRate,
  kYawRate,
  kNorth,
  kEast,
  kDown,
  kFromNorth,
  kFromEast,
  kFuel,
  kNoseWheel,
  kLeftWheel,
  kRightWheel,
  kOuts
};
constexpr Property kOut[] = {
    {"/sim/time/elapsed-sec", "double", "%.6f"},
    {"/position/latitude-deg", "double", "%.9f"},
    {"/position/longitude-deg", "double", "%.9f"},
    {"/position/altitude-ft", "double", "%.4f"},
    {"/orientation/roll-deg", "double", "%.6f"},
    {"/orientation/pitch-deg", "double", "%.6f"},
    {"/orientation/heading-deg", "double", "%.6f"},
    {"/orientation/p-body", "double", "%.7f"},  // [rad/s], these three
    {"/orientation/q-body", "double", "%.7f"},
    {"/orientation/r-body", "double", "%.7f"},
    {"/velocities/speed-north-fps", "double", "%.5f"},
    {"/velocities/speed-east-fps", "double", "%.5f"},
    {"/velocities/speed-down-fps", "double", "%.5f"},
    {"/environment/wind-from-north-fps", "double", "%.4f"},
    {"/environment/wind-from-east-fps", "double", "%.4f"},
    {"/consumables/fuel/total-fuel-norm", "double", "%.5f"},
    {"/gear/gear[0]/wow", "bool", "%d"},
    {"/gear/gear[1]/wow", "bool", "%d"},
    {"/gear/gear[2]/wow", "bool", "%d"},
};
static_assert(std::size(kOut) == kOuts);

constexpr Property kIn[] = {
    {"/controls/flight/aileron", "double", "%.6f"},
    {"/controls/flight/elevator", "double", "%.6f"},
    {"/controls/flight/rudder", "double", "%.6f"},
    {"/controls/engines/engine[0]/throttle", "double", "%.6f"},
    {"/controls/engines/engine[1]/throttle", "double", "%.6f"},
    {"/controls/gear/brake-left", "double", "%.6f"},
    {"/controls/gear/brake-right", "double", "%.6f"},
    // The last, so that a line may end before them.
    {"/environment/wind-from-north-fps", "double", "%.4f"},
    {"/environment/wind-from-east-fps", "double", "%.4f"},
};

void write_chunks(std::span<const Property> properties, const char* direction,
                  std::string_view mark, std::string& text) {
  auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "    <{}>\n      <binary_mode>false</binary_mode>\n"
                 "      <line_separator>newline</line_separator>\n"
                 "      <var_separator>,</var_separator>\n",
                 direction);
  for (const Property& each : properties) {
    fmt::format_to(out,
                   "      <chunk><node>{}</node><type>{}</type>"
                   "<format>{}{}</format></chunk>\n",
                   each.node, each.type, mark, each.format);
    mark = {};
  }
  fmt::format_to(out, "    </{}>\n", direction);
}

Error no_line(std::string_view why) {
  return {ErrorCode::kBadInput, "", fmt::format("this is no line of skein.xml: {}.", why),
          ""};
}

// The numbers of a line behind its mark; each is read to its comma.
Result<std::array<double, kOuts>> numbers_of(std::string_view line) {
  std::array<double, kOuts> numbers{};
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (at == end || *at != ',')
      return no_line(fmt::format("number {} is missing", k + 1));
    ++at;
    const auto read = std::from_chars(at, end, numbers[k]);
    if (read.ec != std::errc()) return no_line(fmt::format("number {} is none", k + 1));
    at = read.ptr;
  }
  if (at != end) return no_line("it is too long");
  return numbers;
}

// -0 is written as 0.
double shown_number(double value) {
  return value + 0.0;
}

}  // namespace

std::string flightgear_protocol() {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<!-- What FlightGear and Skein say to each other; docs/outside-physics.md -->\n"
      "<PropertyList>\n  <generic>\n";
  write_chunks(kOut, "output", std::string(kMark) + ",", text);
  write_chunks(kIn, "input", {}, text);
  return text + "  </generic>\n</PropertyList>\n";
}

Result<FlightState> parse_flightgear(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r'))
    line.remove_suffix(1);
  if (!line.starts_with(kMark)) return no_line("its begin is another");
  const auto read = numbers_of(line.substr(kMark.size()));
  if (!read) return read.error();
  const auto& n = read.value();
  for (const double each : n)
    if (!std::isfinite(each)) return no_line("a number is not finite");
  FlightState state;
  state.time = n[kTime];
  state.place = {n[kLatitude], n[kLongitude], kFoot * n[kAltitude]};
  state.q_NB = geo::from_euler(
      {geo::radians(n[kRoll]), geo::radians(n[kPitch]), geo::radians(n[kHeading])});
  state.w_NB_B = {n[kRollRate], n[kPitchRate], n[kYawRate]};
  state.v_N = kFoot * Vec3(n[kNorth], n[kEast], n[kDown]);
  state.wind_N = -kFoot * Vec3(n[kFromNorth], n[kFromEast], 0);
  state.fuel = n[kFuel];
  state.on_ground = n[kNoseWheel] != 0 || n[kLeftWheel] != 0 || n[kRightWheel] != 0;
  if (auto checked = check(state); !checked) return checked.error();
  return state;
}

std::string flightgear_line(const FlightControls& controls) {
  // Its elevator is positive where the nose goes down.
  std::string line = fmt::format(
      "{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}", shown_number(controls.aileron),
      shown_number(-controls.elevator), shown_number(controls.rudder), controls.throttle,
      controls.throttle, controls.brake, controls.brake);
  if (controls.wind_N)
    fmt::format_to(std::back_inserter(line), ",{:.4f},{:.4f}",
                   shown_number(-controls.wind_N->x() / kFoot),
                   shown_number(-controls.wind_N->y() / kFoot));
  return line + "\n";
}

}  // namespace skein::flight_model
