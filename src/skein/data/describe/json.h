// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/describe/type_traits.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

/// Described values as JSON, in the units of their descriptions: one object a value, with
/// the names of the columns of the run database. A list is an array, a choice an object
/// whose "kind" says what was chosen, with a "value" where that has a kind of its own; of
/// a nameless choice kind and fields stand among the others. Numbers that are not finite
/// are null, and null leaves a field as it is.
///
/// Includes all of the JSON library: for source files only.
namespace skein::json {

using Json = nlohmann::ordered_json;

/// JSON in one line. Never fails: text that is no UTF-8, which only a plugin's own values
/// can hold (valid_text.h), is written with U+FFFD in its place.
inline std::string line_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// `name` behind `prefix`, with an underscore where both say something.
std::string joined(std::string_view prefix, std::string_view name);

/// The word for an alternative of a choice.
template <class T>
constexpr std::string_view alternative_kind() {
  if constexpr (Described<T>)
    return kind_of<T>();
  else
    return "ring";  // the only bare list among alternatives: corners of an area
}

/// Whether a value has a field of its own that is called "kind": as an alternative of a
/// choice it stands under "value" then, so that both are kept.
template <class T>
constexpr bool has_own_kind() {
  bool found = false;
  if constexpr (Described<T>)
    for_each_field<T>([&](const auto& f) { found = found || f.name == "kind"; });
  return found;
}

namespace detail {

using namespace type_traits;  // NOLINT: the traits are ours

inline Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

template <class T>
Json item(const T& value);

template <Described T>
void put_fields(Json& object, std::string_view prefix, const T& value);

template <class T>
void put_alternative(Json& object, const T& chosen) {
  object["kind"] = alternative_kind<T>();
  if constexpr (has_own_kind<T>())
    object["value"] = item(chosen);
  else if constexpr (Described<T>)
    put_fields(object, "", chosen);
  else
    object["points"] = item(chosen);
}

template <class V>
void put_vector(Json& object, std::string_view name, const Axes& axes, const V& v) {
  for (int k = 0; k < v.size(); ++k)
    object[joined(name, axes.names[k]).append(axes.unit.suffix)] =
        number((k == 2 ? axes.third_sign : 1) * v[k] * axes.unit.factor);
}

inline void put_attitude(Json& object, std::string_view name, const Quat& q) {
  const geo::Euler e = geo::to_euler(q);
  object[joined(name, "heading_deg")] = geo::degrees(geo::wrap_2pi(e.yaw));
  object[joined(name, "roll_deg")] = geo::degrees(e.roll);
  object[joined(name, "pitch_deg")] = geo::degrees(e.pitch);
}

template <class Form>
double factor_of(const Form& form) {
  if constexpr (std::is_same_v<Form, Unit>)
    return form.factor;
  else
    return 1;
}
template <class Form>
std::string_view suffix_of(const Form& form) {
  if constexpr (std::is_same_v<Form, Unit>)
    return form.suffix;
  else
    return {};
}

// The name of a value that is one number or word: with its unit.
template <class T, class Form>
std::string name_in_object(std::string_view name, const Form& form) {
  if constexpr (std::is_same_v<T, Time>)
    return joined(name, "s");
  else
    return std::string(name).append(suffix_of(form));
}

template <class T, class Form>
void put(Json& object, std::string_view name, const Form& form, const T& value) {
  if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
    put_vector(object, name, form, value);
  } else if constexpr (std::is_same_v<T, Quat>) {
    put_attitude(object, name, value);
  } else if constexpr (std::is_same_v<T, Time>) {
    object[joined(name, "s")] = value.seconds();
  } else if constexpr (kIsArray<T>) {
    for (std::size_t k = 0; k < value.size(); ++k)
      put(object, joined(name, std::to_string(k + 1)), form, value[k]);
  } else if constexpr (kIsOptional<T>) {
    if (value)
      put(object, name, form, *value);
    else
      object[name_in_object<typename T::value_type>(name, form)] = nullptr;
  } else if constexpr (Described<T>) {
    put_fields(object, name, value);
  } else if constexpr (kIsVariant<T>) {
    Json chosen = Json::object();
    Json& place = name.empty() ? object : chosen;
    std::visit([&](const auto& alternative) { put_alternative(place, alternative); },
               value);
    if (!name.empty()) object[std::string(name)] = std::move(chosen);
  } else if constexpr (std::is_same_v<T, double>) {
    object[std::string(name).append(suffix_of(form))] = number(value * factor_of(form));
  } else {
    object[std::string(name).append(suffix_of(form))] = item(value);
  }
}

template <Described T>
void put_fields(Json& object, std::string_view prefix, const T& value) {
  for_each_field<T>([&](const auto& f) {
    put(object, joined(prefix, f.name), f.form, value.*f.member);
  });
}

template <class T>
Json item(const T& value) {
  if constexpr (kIsVector<T>) {
    Json list = Json::array();
    for (const auto& one : value) list.push_back(item(one));
    return list;
  } else if constexpr (std::is_same_v<T, Vec2>) {
    return Json::array({number(value.x()), number(value.y())});
  } else if constexpr (Described<T>) {
    Json object = Json::object();
    put_fields(object, "", value);
    return object;
  } else if constexpr (NamedEnum<T>) {
    return name_of(value);
  } else if constexpr (WrittenAsName<T>) {
    return value.name();
  } else if constexpr (kIsId<T>) {
    return value.value;
  } else if constexpr (std::is_same_v<T, double>) {
    return number(value);
  } else {
    return value;  // flags, integers, text
  }
}

/// Takes fields out of an object, and remembers what was wrong with the first that was.
class Taker {
 public:
  explicit Taker(const Json& object) : object_(object) {}

  template <Described T>
  void take_fields(std::string_view prefix, T& value) {
    for_each_field<T>(
        [&](const auto& f) { take(joined(prefix, f.name), f.form, value.*f.member); });
  }
  /// What was chosen, as an object with its kind says it.
  template <class... Ts>
  void take_choice(std::variant<Ts...>& value) {
    take_choice(*this, "", value);
  }
  /// What was wrong, for people; empty when nothing was.
  const std::string& wrong() const { return wrong_; }

 private:
  // The value of a name; null when there is none.
  const Json* find(const std::string& name);
  // Whether there are values under names that begin with `name_`.
  bool has_parts(const std::string& name) const;
  void fail(const std::string& name, const char* what);

  template <class T, class Form>
  void take(const std::string& name, const Form& form, T& value) {
    if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
      for (int k = 0; k < value.size(); ++k)
        take_number(joined(name, form.names[k]).append(form.unit.suffix),
                    form.unit.factor * (k == 2 ? form.third_sign : 1), value[k]);
    } else if constexpr (std::is_same_v<T, Quat>) {
      take_attitude(name, value);
    } else if constexpr (std::is_same_v<T, Time>) {
      double seconds = value.seconds();
      take_number(joined(name, "s"), 1, seconds);
      if (std::abs(seconds) < 9e9)
        value = Time::from_seconds(seconds);
      else
        fail(name, "is no time of a run");
    } else if constexpr (kIsArray<T>) {
      for (std::size_t k = 0; k < value.size(); ++k)
        take(joined(name, std::to_string(k + 1)), form, value[k]);
    } else if constexpr (kIsOptional<T>) {
      using Inner = typename T::value_type;
      if constexpr (std::is_same_v<Inner, Vec2> || std::is_same_v<Inner, Vec3>) {
        // A vector is its components, each under a name of its own.
        if (find(joined(name, form.names[0]).append(form.unit.suffix)))
          take(name, form, value.emplace());
      } else if constexpr (Described<Inner>) {
        // Where it is missing its own name is null, whatever others begin with it.
        const Json* missing = find(name);
        if (!(missing && missing->is_null()) && has_parts(name))
          take(name, form, value.emplace());
      } else {
        const Json* found = find(name_in_object<Inner>(name, form));
        if (found && !found->is_null()) take(name, form, value.emplace());
      }
    } else if constexpr (Described<T>) {
      take_fields(name, value);
    } else if constexpr (std::is_same_v<T, double>) {
      take_number(name + std::string(suffix_of(form)), factor_of(form), value);
    } else {
      take_one(name, value);
    }
  }

  template <class T>
  void take_one(const std::string& name, T& value) {
    if constexpr (kIsVariant<T>) {
      if (name.empty()) return take_choice(*this, name, value);
      const Json* found = find(name);
      if (!found || found->is_null()) return;
      if (!found->is_object()) return fail(name, "must be an object");
      Taker inner(*found);
      take_choice(inner, name, value);
      if (!inner.wrong().empty()) fail(name, inner.wrong().c_str());
    } else {
      const Json* found = find(name);
      if (found && !found->is_null() && !take_item(*found, value))
        fail(name, "is not what it should be");
    }
  }

  template <class... Ts>
  void take_choice(Taker& from, const std::string& name, std::variant<Ts...>& value) {
    const Json* kind = from.find("kind");
    if (!kind || !kind->is_string()) return fail(joined(name, "kind"), "is missing");
    bool known = false;
    const auto attempt = [&]<class T>() {
      if (known || *kind != alternative_kind<T>()) return;
      known = true;
      T& chosen = value.template emplace<T>();
      if constexpr (has_own_kind<T>())
        from.take_one("value", chosen);
      else if constexpr (Described<T>)
        from.take_fields("", chosen);
      else
        from.take_one("points", chosen);
    };
    (attempt.template operator()<Ts>(), ...);
    if (!known) fail(joined(name, "kind"), "is no known kind");
  }

  template <class Wide, class T>
  static bool fits(Wide wide, T& value) {
    value = static_cast<T>(wide);
    return std::cmp_equal(value, wide);
  }

  void take_number(const std::string& name, double factor, double& value);
  void take_attitude(const std::string& name, Quat& value);

  // Whether the JSON was such a thing.
  template <class T>
  bool take_item(const Json& from, T& value) {
    if constexpr (kIsVector<T>) {
      if (!from.is_array()) return false;
      value.clear();
      for (const Json& one : from)
        if (!take_item(one, value.emplace_back())) return false;
      return true;
    } else if constexpr (std::is_same_v<T, Vec2>) {
      if (!from.is_array() || from.size() != 2) return false;
      return take_item(from[0], value.x()) && take_item(from[1], value.y());
    } else if constexpr (Described<T>) {
      if (!from.is_object()) return false;
      Taker inner(from);
      inner.take_fields("", value);
      return inner.wrong().empty();
    } else if constexpr (NamedEnum<T>) {
      const auto names = names_of(static_cast<const T*>(nullptr));
      for (std::size_t k = 0; k < names.size(); ++k)
        if (from == names[k]) {
          value = static_cast<T>(k);
          return true;
        }
      return false;
    } else if constexpr (WrittenAsName<T>) {
      if (from.is_string()) value = T::named(from.template get<std::string>());
      return from.is_string();
    } else if constexpr (kIsId<T>) {
      return take_item(from, value.value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (from.is_string()) value = from.template get<std::string>();
      return from.is_string();
    } else if constexpr (std::is_same_v<T, bool>) {
      if (from.is_boolean()) value = from.template get<bool>();
      return from.is_boolean();
    } else if constexpr (std::is_integral_v<T>) {
      if (!from.is_number_integer()) return false;
      if (from.is_number_unsigned())
        return fits(from.template get<std::uint64_t>(), value);
      return fits(from.template get<std::int64_t>(), value);
    } else {
      if (from.is_number()) value = from.template get<T>();
      return from.is_number();
    }
  }

  const Json& object_;
  std::string wrong_;
};

}  // namespace detail

/// The value as a JSON object.
template <Described T>
Json to_json(const T& value) {
  return detail::item(value);
}

/// What was chosen, as an object with its kind.
template <class... Ts>
Json to_json(const std::variant<Ts...>& value) {
  Json object = Json::object();
  std::visit([&](const auto& chosen) { detail::put_alternative(object, chosen); }, value);
  return object;
}

/// Takes a choice out of text that to_json() made. Says whether it made sense.
template <class... Ts>
bool from_text(const std::string& text, std::variant<Ts...>& value) {
  const Json object = Json::parse(text, nullptr, false);
  if (!object.is_object()) return false;
  detail::Taker taker(object);
  taker.take_choice(value);
  return taker.wrong().empty();
}

/// The value that an object describes. Fields that it does not have keep their defaults.
/// Fails: kBadInput when it is no object, or a field is not what it should be.
///        A choice is an object with its kind, as to_json() writes it.
template <class T>
requires(Described<T> ||
         type_traits::kIsVariant<T>) Result<T> from_json(const Json& object) {
  if (!object.is_object())
    return Error{ErrorCode::kBadInput, "", "this is no JSON object.", ""};
  T value;
  detail::Taker taker(object);
  if constexpr (type_traits::kIsVariant<T>)
    taker.take_choice(value);
  else
    taker.take_fields("", value);
  if (!taker.wrong().empty()) return Error{ErrorCode::kBadInput, "", taker.wrong(), ""};
  return value;
}

}  // namespace skein::json
