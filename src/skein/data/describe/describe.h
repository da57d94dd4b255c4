// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

/// Descriptions of values: what a struct that crosses a boundary is made of, said once.
///
/// Beside the struct stands a function that argument-dependent lookup finds:
///
///   struct Crossing { Time time; EntityId aircraft; Vec2 point; ... };
///   constexpr auto describe(const Crossing*) {
///     using T = Crossing;
///     return described<T>({"crossing", "crossings"}, "The boundary was passed.",
///                         field("time", &T::time, "of the later reading"), ...);
///   }
///
/// Content hash, wire form (data/describe/wire.h), tables of the run database, JSON,
/// TypeScript types and docs/records.md follow from it. Nothing else lists the fields of
/// a value.
///
/// The order of the fields is part of the wire form: new ones go to the end, and none is
/// taken away.
namespace skein {

/// How a number is written at edges: files, JSON, databases, pages.
struct Unit {
  std::string_view suffix = {};  ///< of the name, with its underscore: "_m"
  double factor = 1;             ///< from SI and radians to what is written
};

namespace unit {
inline constexpr Unit kNone{};
inline constexpr Unit kMetre{"_m"};
inline constexpr Unit kMetrePerSecond{"_mps"};
inline constexpr Unit kMetrePerSecondSquared{"_mps2"};
inline constexpr Unit kSecond{"_s"};
inline constexpr Unit kDegree{"_deg", 57.295779513082320877};
inline constexpr Unit kDegreePerSecond{"_dps", 57.295779513082320877};
inline constexpr Unit kVolt{"_v"};
inline constexpr Unit kWatt{"_w"};
inline constexpr Unit kKilogramPerCubicMetre{"_kg_m3"};
}  // namespace unit

/// How the components of a vector are written. Of a Vec2 the first two count.
struct Axes {
  std::string_view names[3];
  Unit unit;
  double third_sign = 1;  ///< -1: down inside, up where it is written
};

namespace axes {
inline constexpr Axes kPlace{{"north", "east", "altitude_msl"}, unit::kMetre, -1};
inline constexpr Axes kOffset{{"north", "east", "down"}, unit::kMetre};
inline constexpr Axes kVelocity{
    {"velocity_north", "velocity_east", "climb"}, unit::kMetrePerSecond, -1};
inline constexpr Axes kWind{{"wind_north", "wind_east", "wind_down"},
                            unit::kMetrePerSecond};
inline constexpr Axes kDirection{{"north", "east", "down"}, unit::kNone};
inline constexpr Axes kBodyDirection{{"forward", "right", "down"}, unit::kNone};
inline constexpr Axes kFormation{{"forward", "right", "down"}, unit::kMetre};
inline constexpr Axes kBodyRates{{"roll_rate", "pitch_rate", "yaw_rate"},
                                 unit::kDegreePerSecond};
}  // namespace axes

/// How the run database keeps a list or a choice; columns for everything else.
enum class Storage : std::uint8_t {
  kJson,      ///< as text
  kFloats,    ///< little-endian 32-bit floats, number after number
  kKindOnly,  ///< of a choice the name of what was chosen, nothing more
  kCoded,     ///< a choice as text, and beside it in its wire form, which loses nothing;
              ///< a list in its wire form alone
  kBytes,     ///< a list of bytes as it is
};

/// One field of a struct T.
template <class T, class M, class Form>
struct Field {
  std::string_view name;  ///< without unit; empty: the parts' names say all
  M T::*member;
  Form form;  ///< Unit, Axes or Storage
  std::string_view help;
  bool in_tables = true;  ///< it has columns in the run database
  bool hashed = true;     ///< it counts for the content hash
};

template <class T, class M>
constexpr auto field(std::string_view name, M T::*member, std::string_view help) {
  return Field<T, M, Unit>{name, member, unit::kNone, help};
}
template <class T, class M, class Form>
constexpr auto field(std::string_view name, M T::*member, Form form,
                     std::string_view help) {
  return Field<T, M, Form>{name, member, form, help};
}

/// A field that the run database leaves out; hash, wire form and JSON have it.
template <class T, class M, class Form>
constexpr auto untabled(Field<T, M, Form> field) {
  field.in_tables = false;
  return field;
}

/// A field that the content hash leaves out; all else has it.
template <class T, class M, class Form>
constexpr auto unhashed(Field<T, M, Form> field) {
  field.hashed = false;
  return field;
}

/// What a value of a kind is called.
struct KindName {
  std::string_view kind;        ///< in messages and JSON: lower case, underscores
  std::string_view table = {};  ///< of the run database; empty: it has none of its own
};

/// Fields of different types, by their places. std::tuple checks, for each list of types,
/// in how many ways it can be built: with many structs most of the time of compiling.
template <std::size_t K, class F>
struct FieldAt {
  F field;
};
template <class Places, class... Fields>
struct FieldList;
template <std::size_t... K, class... Fields>
struct FieldList<std::index_sequence<K...>, Fields...> : FieldAt<K, Fields>... {
  template <class Visit>
  constexpr void for_each(Visit&& visit) const {
    (visit(static_cast<const FieldAt<K, Fields>&>(*this).field), ...);
  }
};

template <class T, class... Fields>
struct Description {
  KindName name;
  std::string_view help;
  FieldList<std::index_sequence_for<Fields...>, Fields...> fields;
  static constexpr std::size_t kFields = sizeof...(Fields);
};

template <class T, class... Fields>
constexpr auto described(KindName name, std::string_view help, Fields... fields) {
  return Description<T, Fields...>{name, help, {{fields}...}};
}

/// A struct with a description.
template <class T>
concept Described = requires(const T* t) {
  describe(t).fields;
};

template <Described T>
inline constexpr auto kDescription = describe(static_cast<const T*>(nullptr));

/// The word for values of type T in messages, tables and JSON.
template <Described T>
constexpr std::string_view kind_of() {
  return kDescription<T>.name.kind;
}

/// Calls `visit(field)` for each field in order.
template <Described T, class Visit>
constexpr void for_each_field(Visit&& visit) {
  kDescription<T>.fields.for_each(visit);
}

/// An enumeration whose words are given by names_of(), in the order of its values from 0.
template <class E>
concept NamedEnum = std::is_enum_v<E> && requires(const E* e) {
  names_of(e).size();
};

/// The word for a value, as records, messages and files have it.
template <NamedEnum E>
constexpr std::string_view name_of(E value) {
  return names_of(static_cast<const E*>(nullptr))[static_cast<std::size_t>(value)];
}

/// A value that is its name wherever it is written: name() gives it, named() makes one of
/// any text.
template <class T>
concept WrittenAsName = requires(const T& value, std::string_view text) {
  { value.name() } -> std::convertible_to<std::string_view>;
  { T::named(text) } -> std::same_as<T>;
};

}  // namespace skein
