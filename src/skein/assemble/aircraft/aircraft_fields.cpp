// SPDX-License-Identifier: Apache-2.0
// What all aircraft files share: errors at the keys of the file, inertia, battery,
// ground.
#include "skein/assemble/aircraft/aircraft_fields.h"

#include <algorithm>
#include <cctype>

#include "skein/scenario/units.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Object;
using scenario::Range;
using scenario::Type;

// The object that a value of this type is, may be or is a list of; null for anything
// else.
const Object* object_in(const Type& type) {
  if (const auto* optional = std::get_if<scenario::OptionalType>(&type.what))
    return object_in(*optional->inner);
  if (const auto* list = std::get_if<scenario::ListType>(&type.what))
    return object_in(*list->element);
  const auto* object = std::get_if<scenario::ObjectType>(&type.what);
  return object ? object->object.get() : nullptr;
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

// The key that is named like a member, perhaps with its unit behind.
const scenario::Field* field_like(const Object& keys, std::string_view member) {
  const auto named = [&](auto&& same) -> const scenario::Field* {
    for (const scenario::Field& field : keys.fields)
      if (same(field.key, member) || same(scenario::stem_of(field.key), member))
        return &field;
    return nullptr;
  };
  // CL0 and Cl0 are two coefficients: letters as they are come first.
  const auto* exact =
      named([](std::string_view a, std::string_view b) { return a == b; });
  return exact ? exact : named(same_letters);
}

}  // namespace

std::string file_key(const Object& keys, std::string_view member) {
  std::string path;
  const Object* here = &keys;
  while (here && !member.empty()) {
    const std::size_t dot = std::min(member.find('.'), member.size());
    std::string_view part = member.substr(0, dot);
    member.remove_prefix(std::min(dot + 1, member.size()));
    const std::size_t bracket = std::min(part.find('['), part.size());
    const scenario::Field* field = field_like(*here, part.substr(0, bracket));
    if (!field) continue;
    if (!path.empty()) path += '.';
    path += field->key + std::string(part.substr(bracket));
    here = object_in(*field->type);
  }
  return path;
}

std::vector<scenario::RuleViolation> at_file_keys(
    const Object& keys, const std::vector<asset::ParameterError>& errors) {
  std::vector<scenario::RuleViolation> found;
  for (const asset::ParameterError& error : errors) {
    const std::string key = file_key(keys, error.key);
    const bool in_degrees = key.find("_deg") != std::string::npos;
    found.push_back(
        {key,
         error.message + (in_degrees ? " (in radians; the file has degrees)." : ".")});
  }
  return found;
}

Fields<asset::Inertia> inertia_fields() {
  using T = asset::Inertia;
  constexpr Range kMoment{.above = 0, .at_most = 1e9};
  constexpr Range kProduct{.at_least = -1e9, .at_most = 1e9};
  return Fields<T>()
      .number("xx_kgm2", &T::xx, "Moment about the forward axis.", kMoment)
      .required()
      .number("yy_kgm2", &T::yy, "About the right axis.", kMoment)
      .required()
      .number("zz_kgm2", &T::zz, "About the down axis.", kMoment)
      .required()
      .number("xy_kgm2", &T::xy, "Product of forward and right.", kProduct)
      .number(
          "xz_kgm2", &T::xz,
          "Product of forward and down: the tensor has minus this beside the diagonal.",
          kProduct)
      .number("yz_kgm2", &T::yz, "Product of right and down.", kProduct)
      .rules([](const T& inertia) {
        asset::ParameterCheck check;
        check.inertia("", inertia);
        return at_file_keys(Object{}, check.take());
      });
}

BatteryFile BatteryFile::of(const asset::BatteryParameters& battery) {
  return {battery, {battery.open_circuit.begin(), battery.open_circuit.end()}};
}

asset::BatteryParameters BatteryFile::parameters() const {
  asset::BatteryParameters all = battery;
  if (open_circuit.size() == all.open_circuit.size())
    std::copy_n(open_circuit.begin(), all.open_circuit.size(), all.open_circuit.begin());
  return all;
}

Fields<BatteryFile> battery_fields() {
  using T = BatteryFile;
  constexpr Range kVolts{.above = 0, .at_most = 10};
  return Fields<T>()
      .number("cells", [](T & t) -> auto& { return t.battery.cells; }, "In series.",
              {.at_least = 1, .at_most = 1000})
      .required()
      .number("capacity_ah", [](T & t) -> auto& { return t.battery.capacity_Ah; },
              "Of one cell, as all carry the same current.", {.above = 0, .at_most = 1e5})
      .required()
      .number("resistance_ohm", [](T & t) -> auto& { return t.battery.resistance; },
              "Inside the whole pack, wires included.", {.above = 0, .at_most = 100})
      .required()
      .number("cutoff_v", [](T & t) -> auto& { return t.battery.cutoff; },
              "Lowest voltage of one cell under load.", {.at_least = 0, .at_most = 10})
      .number("open_circuit_v", &T::open_circuit,
              "Voltages of one cell without load at charges 0, 0.1 ... 1; empty: a "
              "lithium-polymer cell.",
              kVolts)
      .rules([](const T& file) -> std::vector<scenario::RuleViolation> {
        const std::size_t all = file.battery.open_circuit.size();
        if (!file.open_circuit.empty() && file.open_circuit.size() != all)
          return {
              {"open_circuit_v", "needs 11 voltages, at charges 0, 0.1 ... 1, or none."}};
        return at_file_keys(*battery_fields().description(), errors(file.parameters()));
      });
}

Fields<asset::FuelTankParameters> tank_fields() {
  using T = asset::FuelTankParameters;
  return Fields<T>()
      .number("fuel_kg", &T::fuel, "When full.", {.above = 0, .at_most = 1e5})
      .required()
      .number("consumption_kg_per_j", &T::consumption, "For work at the shaft.",
              {.above = 0, .at_most = 1e-3})
      .required()
      .number("idle_consumption_kg_per_s", &T::idle_consumption,
              "Beside it, as long as the engine runs.", {.at_least = 0, .at_most = 10})
      .required();
}

Fields<asset::GroundContactParameters> ground_fields() {
  using T = asset::GroundContactParameters;
  constexpr Range kFriction{.at_least = 0, .at_most = 10};
  return Fields<T>()
      .number("sink_limit_mps", &T::sink_limit, "Touching down faster breaks it.",
              {.at_least = 0, .at_most = 1000})
      .number("speed_limit_mps", &T::speed_limit,
              "Touching down with more horizontal speed trips it over; large: never.",
              {.at_least = 0, .at_most = 1e6})
      .angle_deg("tilt_limit_deg", &T::tilt_limit, "Touching down more tilted breaks it.",
                 {.above = 0, .at_most = 180})
      .number("friction_along", &T::friction_along,
              "Coefficient along the body: wheels 0.03 to 0.1.", kFriction)
      .number("friction_across", &T::friction_across, "Coefficient across the body.",
              kFriction)
      .number("brake_friction", &T::brake_friction,
              "On top along the body at full brake; 0: it has no brakes.", kFriction)
      .angle_deg("rest_pitch_deg", &T::rest_pitch, "Pitch at which it stands.",
                 {.at_least = -45, .at_most = 45})
      .duration_s("levelling_s", &T::levelling, "Time constant of coming level.",
                  {.above = 0})
      .number(
          "nose_fall_rad_per_m", &T::nose_fall,
          "How the nose falls in the take-off run: mass times distance of the main "
          "wheels behind the centre of gravity over the inertia about the right axis. "
          "Negative: it stands on feet all around.",
          {.at_least = -1e6, .at_most = 1e6})
      .number("yaw_grip_rad_per_m", &T::yaw_grip,
              "Turn rate that the ground stops per vertical speed that it stops.",
              {.at_least = 0, .at_most = 1e6})
      .number("steering_rad_per_m", &T::steering,
              "Turn per distance that wheels make at full rudder; 0: they do not steer.",
              {.at_least = 0, .at_most = 10})
      .rules([](const T& ground) {
        return at_file_keys(*ground_fields().description(), errors(ground));
      });
}

}  // namespace skein::assemble
