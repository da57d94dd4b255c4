// SPDX-License-Identifier: Apache-2.0
// skein fly --trim: steady flights of a fixed wing.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/assemble/aircraft/flight_table.h"
#include "skein/geo/vec.h"
#include "skein/layer/asset/fixed_wing/linear_model.h"

namespace skein::app {
namespace {

using asset::FixedWingModel;
using asset::Trim;
using asset::TrimRequest;
using asset::TrimResult;
using Json = nlohmann::ordered_json;

constexpr int kTableRows = 9;

TrimRequest request_at(double airspeed, const TrimArguments& a) {
  TrimRequest request{airspeed, geo::radians(a.climb_deg), 0, a.altitude};
  if (a.turn_radius != 0)
    request.turn_rate = airspeed * std::cos(request.climb_angle) / a.turn_radius;
  else if (a.bank_deg != 0)
    request.turn_rate = kGravity * std::tan(geo::radians(a.bank_deg)) / airspeed;
  return request;
}

Json to_json(const FixedWingModel& model, const TrimRequest& request,
             const TrimResult& result) {
  const Trim& t = result.trim;
  Json json = {{"airspeed_mps", request.airspeed},
               {"climb_deg", geo::degrees(request.climb_angle)},
               {"turn_rate_deg_per_s", geo::degrees(request.turn_rate)},
               {"altitude_msl_m", request.altitude_msl},
               {"found", result.found()}};
  if (!result.found()) json["reason"] = reason(model, result);
  json.update({{"alpha_deg", geo::degrees(t.alpha)},
               {"beta_deg", geo::degrees(t.beta)},
               {"roll_deg", geo::degrees(t.roll)},
               {"pitch_deg", geo::degrees(t.pitch)},
               {"elevator_deg", geo::degrees(t.surfaces.elevator)},
               {"aileron_deg", geo::degrees(t.surfaces.aileron)},
               {"rudder_deg", geo::degrees(t.surfaces.rudder)},
               {"thrust_n", t.thrust},
               {"throttle", t.throttle},
               {"power_w", t.power}});
  return json;
}

// In degrees, without the minus of what rounds to 0.
double shown_deg(double radians) {
  return std::round(geo::degrees(radians) * 1000) / 1000 + 0.0;
}

void print_table(const FixedWingModel& model, const std::vector<TrimRequest>& requests) {
  print("{:>9} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>9} {:>9} {:>9}\n", "airspeed",
        "alpha", "pitch", "roll", "elevator", "aileron", "rudder", "thrust", "throttle",
        "power");
  print("{:>9} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>9} {:>9} {:>9}\n", "m/s", "deg",
        "deg", "deg", "deg", "deg", "deg", "N", "", "W");
  for (const TrimRequest& request : requests) {
    const TrimResult result = asset::find_trim(model, request);
    const Trim& t = result.trim;
    if (!result.found()) {
      print("{:>9.2f}  none: {}\n", request.airspeed, reason(model, result));
      continue;
    }
    print(
        "{:>9.2f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.3f} {:>8.3f} {:>8.3f} {:>9.3f} "
        "{:>9.4f} {:>9.1f}\n",
        request.airspeed, shown_deg(t.alpha), shown_deg(t.pitch), shown_deg(t.roll),
        shown_deg(t.surfaces.elevator), shown_deg(t.surfaces.aileron),
        shown_deg(t.surfaces.rudder), t.thrust, t.throttle, t.power);
  }
}

struct NamedMode {
  const char* name;
  std::complex<double> eigenvalue;
};

// How straight flight answers disturbances, thrust and surfaces being held; none where
// there is no such flight.
std::vector<NamedMode> modes_at(const FixedWingModel& model, const TrimRequest& request) {
  const TrimResult result = asset::find_trim(model, request, asset::TrimThrust::kDirect);
  if (!result.found() || request.turn_rate != 0) return {};
  const asset::Modes m =
      asset::modes(asset::linearise(model, result.trim, request.altitude_msl));
  std::vector<NamedMode> all;
  const auto add_pair = [&](const char* name, const asset::Modes::Pair& pair) {
    all.push_back({name, pair[0]});
    if (pair[0].imag() == 0) all.push_back({name, pair[1]});
  };
  add_pair("short_period", m.short_period);
  add_pair("phugoid", m.phugoid);
  all.push_back({"height", m.height});
  add_pair("dutch_roll", m.dutch_roll);
  if (m.roll_spiral) {
    add_pair("roll_spiral", *m.roll_spiral);
  } else {
    all.push_back({"roll", m.roll});
    all.push_back({"spiral", m.spiral});
  }
  return all;
}

void print_modes(const std::vector<NamedMode>& modes) {
  if (modes.empty()) return;
  print("\nmodes, with surfaces and thrust held:\n");
  for (const NamedMode& mode : modes) {
    const std::complex<double> s = mode.eigenvalue;
    if (std::abs(s) < 1e-9)
      print("  {:<13} stays\n", mode.name);
    else if (s.imag() != 0)
      print("  {:<13} {:.4f} rad/s, damping {:.4f}, period {:.2f} s\n", mode.name,
            asset::natural_frequency(s), asset::damping_ratio(s),
            2 * geo::kPi / std::abs(s.imag()));
    else
      print("  {:<13} {} in {:.3f} s\n", mode.name,
            s.real() < 0 ? "falls to 1/e" : "grows to e", 1 / std::abs(s.real()));
  }
}

Json to_json(const std::vector<NamedMode>& modes) {
  Json all = Json::array();
  for (const NamedMode& mode : modes)
    all.push_back({{"mode", mode.name},
                   {"real_per_s", mode.eigenvalue.real()},
                   {"imaginary_per_s", mode.eigenvalue.imag()}});
  return all;
}

// Without what Newton's method leaves of a zero.
double tidy(double value) {
  return std::abs(value) < 1e-12 ? 0 : value;
}

// A table for `skein fly --input` that holds a trim for a while.
int print_input(const FixedWingModel& model, const TrimRequest& request,
                double duration) {
  const TrimResult result = asset::find_trim(model, request, asset::TrimThrust::kDirect);
  if (!result.found()) {
    complain("There is no such steady flight: {}.\n", reason(model, result));
    return kFailed;
  }
  const Trim& t = result.trim;
  std::string header;
  for (const std::string_view column : assemble::kInputColumns)
    header += fmt::format("{},", column);
  for (const std::string_view column : assemble::kStateColumns)
    header += fmt::format("{},", column);
  header.back() = '\n';
  const std::string inputs =
      fmt::format("{},{},{},{},0,0,0", tidy(t.surfaces.elevator),
                  tidy(t.surfaces.aileron), tidy(t.surfaces.rudder), t.thrust);
  const Vec3 &v = t.v_AB_B, &w = t.w_NB_B;
  print("{}0,{},0,0,{},{},{},{},{},{},0,{},{},{}\n", header, inputs,
        0 - request.altitude_msl, v.x(), tidy(v.y()), v.z(), tidy(t.roll), t.pitch,
        tidy(w.x()), tidy(w.y()), tidy(w.z()));
  print("{},{}\n", duration, inputs);
  return kDone;
}

}  // namespace

int trim_command(const TrimArguments& arguments) {
  const auto aircraft = load_fixed_wing(arguments.aircraft);
  if (!aircraft) return say_error(aircraft.error());
  const FixedWingModel model(aircraft.value());
  const asset::Envelope& envelope = model.envelope;
  if (arguments.hold > 0)
    return print_input(
        model, request_at(arguments.airspeed.value_or(envelope.cruise), arguments),
        arguments.hold);
  std::vector<TrimRequest> requests;
  if (arguments.airspeed) {
    requests = {request_at(*arguments.airspeed, arguments)};
  } else {
    for (int i = 0; i < kTableRows; ++i)
      requests.push_back(request_at(
          envelope.slowest + (envelope.fastest - envelope.slowest) * i / (kTableRows - 1),
          arguments));
  }
  if (arguments.json) {
    Json all = Json::array();
    for (const TrimRequest& request : requests) {
      all.push_back(to_json(model, request, asset::find_trim(model, request)));
      all.back()["modes"] = to_json(modes_at(model, request));
    }
    put_out(all.dump(2) + "\n");
  } else {
    print_table(model, requests);
    if (arguments.airspeed) print_modes(modes_at(model, requests.front()));
  }
  return kDone;
}

}  // namespace skein::app
