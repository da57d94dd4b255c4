// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/data/describe/json.h"
#include "skein/data/describe/wire.h"

/// Described values as rows of a table, one column for each of their numbers.
///
/// Components of vectors and nested structs have columns of their own; a choice has two,
/// kind and json (three with its wire form); a list has one, as Storage says. What is
/// null keeps its default when it is read. Lists that are stored as floats, which have
/// lost their last digits, are not read back.
///
/// Includes all of the JSON library: for source files only.
namespace skein::columns {

/// One column of a table.
struct Column {
  std::string name;       ///< with its unit
  std::string_view type;  ///< INTEGER, REAL, TEXT or BLOB
  std::string_view help;
};

/// The numbers of a value one after the other, as they are written: of lists, item after
/// item.
template <class T>
void put_floats(const T& value, std::vector<float>& out);

namespace detail {

using namespace type_traits;  // NOLINT: the traits are ours
using json::joined;

template <class T>
constexpr std::string_view sql_type() {
  if constexpr (std::is_same_v<T, double>)
    return "REAL";
  else if constexpr (std::is_same_v<T, std::string> || NamedEnum<T> || WrittenAsName<T>)
    return "TEXT";
  else
    return "INTEGER";
}

template <Described T>
void list_fields(std::string_view prefix, std::vector<Column>& out);

template <class T, class Form>
void list(const std::string& name, const Form& form, std::string_view help,
          std::vector<Column>& out) {
  if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(T::RowsAtCompileTime); ++k)
      out.push_back({joined(name, form.names[k]).append(form.unit.suffix), "REAL", help});
  } else if constexpr (std::is_same_v<T, Quat>) {
    for (const char* angle : {"heading_deg", "roll_deg", "pitch_deg"})
      out.push_back({joined(name, angle), "REAL", help});
  } else if constexpr (std::is_same_v<T, Time>) {
    out.push_back({joined(name, "s"), "REAL", help});
  } else if constexpr (kIsArray<T>) {
    for (std::size_t k = 1; k <= std::tuple_size_v<T>; ++k)
      list<typename T::value_type>(joined(name, std::to_string(k)), form, help, out);
  } else if constexpr (kIsOptional<T>) {
    list<typename T::value_type>(name, form, help, out);
  } else if constexpr (Described<T>) {
    list_fields<T>(name, out);
  } else if constexpr (kIsVariant<T>) {
    out.push_back({joined(name, "kind"), "TEXT", help});
    if (form == Storage::kKindOnly) return;
    out.push_back({joined(name, "json"), "TEXT", help});
    if (form == Storage::kCoded) out.push_back({joined(name, "coded"), "BLOB", help});
  } else if constexpr (kIsVector<T>) {
    const bool text = form == Storage::kJson, coded = form == Storage::kCoded;
    out.push_back({text    ? joined(name, "json")
                   : coded ? joined(name, "coded")
                           : name,
                   text ? "TEXT" : "BLOB", help});
  } else {
    out.push_back(
        {name + std::string(json::detail::suffix_of(form)), sql_type<T>(), help});
  }
}

template <Described T>
void list_fields(std::string_view prefix, std::vector<Column>& out) {
  for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
    if (f.in_tables) list<M>(joined(prefix, f.name), f.form, f.help, out);
  });
}

template <Described T, class Sink>
void put_fields(const T& value, Sink& sink);

template <class Sink>
void put_attitude(const Quat& q_NB, Sink& sink) {
  const geo::Euler e = geo::to_euler(q_NB);
  sink.put(geo::degrees(geo::wrap_2pi(e.yaw)));
  sink.put(geo::degrees(e.roll));
  sink.put(geo::degrees(e.pitch));
}

template <class T, class Sink>
void put_list(Storage storage, const T& list, Sink& sink) {
  constexpr bool kOfIds = kIsId<typename T::value_type>;
  if constexpr (std::is_same_v<T, std::vector<std::uint8_t>>) {
    sink.put(std::as_bytes(std::span(list)));
  } else if (storage == Storage::kCoded) {
    std::vector<std::byte> coded;
    wire::encode(list, coded);
    sink.put(std::move(coded));
  } else if (kOfIds || storage == Storage::kJson) {
    sink.put(json::line_of(json::detail::item(list)));
  } else if constexpr (!kOfIds) {
    std::vector<float> floats;
    put_floats(list, floats);
    sink.put(std::move(floats));
  }
}

template <class T, class Sink>
void put_choice(Storage storage, const T& value, Sink& sink) {
  std::visit([&]<class A>(const A&) { sink.put(json::alternative_kind<A>()); }, value);
  if (storage == Storage::kKindOnly) return;
  sink.put(json::line_of(json::to_json(value)));
  if (storage != Storage::kCoded) return;
  std::vector<std::byte> coded;
  wire::encode(value, coded);
  sink.put(std::move(coded));
}

template <class T, class Form, class Sink>
void put(const Form& form, const T& value, Sink& sink) {
  if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
    for (int k = 0; k < value.size(); ++k)
      sink.put((k == 2 ? form.third_sign : 1) * form.unit.factor * value[k]);
  } else if constexpr (std::is_same_v<T, Quat>) {
    put_attitude(value, sink);
  } else if constexpr (std::is_same_v<T, Time>) {
    sink.put(value.seconds());
  } else if constexpr (kIsArray<T>) {
    for (const auto& item : value) put(form, item, sink);
  } else if constexpr (kIsOptional<T>) {
    using Inner = typename T::value_type;
    static_assert(std::is_arithmetic_v<Inner> || kIsId<Inner> ||
                  std::is_same_v<Inner, Time>);
    if (value)
      put(form, *value, sink);
    else
      sink.put(nullptr);
  } else if constexpr (Described<T>) {
    put_fields(value, sink);
  } else if constexpr (kIsVariant<T>) {
    put_choice(form, value, sink);
  } else if constexpr (kIsVector<T>) {
    put_list(form, value, sink);
  } else if constexpr (std::is_same_v<T, double>) {
    const double written = value * json::detail::factor_of(form);
    if (std::isfinite(written))
      sink.put(written);
    else
      sink.put(nullptr);
  } else if constexpr (NamedEnum<T>) {
    sink.put(name_of(value));
  } else if constexpr (WrittenAsName<T>) {
    sink.put(value.name());
  } else if constexpr (kIsId<T>) {
    sink.put(std::int64_t{value.value});
  } else if constexpr (std::is_same_v<T, std::string>) {
    sink.put(std::string_view(value));
  } else {
    sink.put(static_cast<std::int64_t>(value));
  }
}

template <Described T, class Sink>
void put_fields(const T& value, Sink& sink) {
  for_each_field<T>([&](const auto& f) {
    if (f.in_tables) put(f.form, value.*f.member, sink);
  });
}

template <Described T, class Source>
void take_fields(T& value, Source& source);

template <class Source>
void take_attitude(Quat& q_NB, Source& source) {
  geo::Euler e;
  source.take(e.yaw);
  source.take(e.roll);
  source.take(e.pitch);
  q_NB =
      geo::from_euler({geo::radians(e.roll), geo::radians(e.pitch), geo::radians(e.yaw)});
}

template <class... Ts, class Source>
void take_choice(Storage storage, std::variant<Ts...>& value, Source& source) {
  std::string kind, text;
  source.take(kind);
  if (storage == Storage::kKindOnly) return;
  source.take(text);
  if (storage != Storage::kCoded) {
    source.check(json::from_text(text, value), "JSON as a run writes it");
    return;
  }
  std::vector<std::byte> coded;
  source.take(coded);
  auto decoded = wire::decode<std::variant<Ts...>>(coded);
  source.check(decoded.ok(), "a value in the wire form");
  if (decoded) value = std::move(decoded).value();
}

// A whole number, a flag or an id. @returns whether there was one.
template <class T, class Source>
bool take_whole(T& value, Source& source) {
  std::int64_t written = 0;
  if (!source.take(written)) return false;
  if constexpr (kIsId<T>) {
    const bool fits = std::in_range<std::uint32_t>(written);
    source.check(fits, "a number of an entity");
    if (fits) value.value = static_cast<std::uint32_t>(written);
  } else if constexpr (std::is_same_v<T, bool>) {
    source.check(written == 0 || written == 1, "0 or 1");
    value = written != 0;
  } else {
    const bool fits = std::in_range<T>(written);
    source.check(fits, "a whole number that fits");
    if (fits) value = static_cast<T>(written);
  }
  return true;
}

template <class Source>
bool take_time(Time& value, Source& source) {
  constexpr double kMaxSeconds = 9.2e9;  // what a Time holds
  double seconds = 0;
  if (!source.take(seconds)) return false;
  const bool fits = std::abs(seconds) <= kMaxSeconds;
  source.check(fits, "a time from -9.2e9 to 9.2e9 s");
  if (fits) value = Time::from_seconds(seconds);
  return true;
}

template <class T, class Form, class Source>
void take(const Form& form, T& value, Source& source) {
  if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
    for (int k = 0; k < value.size(); ++k) {
      double written = 0;
      if (source.take(written))
        value[k] = (k == 2 ? form.third_sign : 1) * written / form.unit.factor;
    }
  } else if constexpr (std::is_same_v<T, Quat>) {
    take_attitude(value, source);
  } else if constexpr (std::is_same_v<T, Time>) {
    take_time(value, source);
  } else if constexpr (kIsArray<T>) {
    for (auto& item : value) take(form, item, source);
  } else if constexpr (kIsOptional<T>) {
    if constexpr (std::is_same_v<T, std::optional<Time>>) {
      Time time;
      if (take_time(time, source)) value = time;
    } else if constexpr (std::is_same_v<T, std::optional<double>>) {
      double written = 0;
      if (source.take(written)) value = written / json::detail::factor_of(form);
    } else {
      typename T::value_type inner{};
      if (take_whole(inner, source)) value = inner;
    }
  } else if constexpr (Described<T>) {
    take_fields(value, source);
  } else if constexpr (kIsVariant<T>) {
    take_choice(form, value, source);
  } else if constexpr (kIsVector<T>) {
    if (form != Storage::kCoded) return void(source.skip());
    std::vector<std::byte> coded;
    source.take(coded);
    auto decoded = wire::decode<T>(coded);
    source.check(decoded.ok(), "what the wire form makes of a list");
    if (decoded) value = std::move(decoded).value();
  } else if constexpr (std::is_same_v<T, double>) {
    double written = 0;
    if (source.take(written)) value = written / json::detail::factor_of(form);
  } else if constexpr (NamedEnum<T>) {
    std::string word;
    const auto names = names_of(static_cast<const T*>(nullptr));
    if (!source.take(word)) return;
    const auto found = std::find(names.begin(), names.end(), word);
    source.check(found != names.end(), "a word that is known");
    if (found != names.end()) value = static_cast<T>(found - names.begin());
  } else if constexpr (WrittenAsName<T>) {
    std::string name;
    if (source.take(name)) value = T::named(name);
  } else if constexpr (std::is_same_v<T, std::string>) {
    source.take(value);
  } else {
    take_whole(value, source);
  }
}

template <Described T, class Source>
void take_fields(T& value, Source& source) {
  for_each_field<T>([&](const auto& f) {
    if (f.in_tables) take(f.form, value.*f.member, source);
  });
}

}  // namespace detail

/// The columns of a kind, in the order in which put() gives their values.
template <Described T>
std::vector<Column> columns_of() {
  std::vector<Column> all;
  detail::list_fields<T>("", all);
  return all;
}

/// Gives the values of a row to `sink.put(...)`: double, std::int64_t and nullptr; text
/// and bytes of the value as std::string_view and std::span<const std::byte>; what was
/// made for the row as std::string, std::vector<float> and std::vector<std::byte>.
template <Described T, class Sink>
void put(const T& value, Sink& sink) {
  detail::put_fields(value, sink);
}

/// Takes the values of a row from `source`: `take(double&)`, and so on, say whether there
/// was one; `skip()` passes one over; `check(bool, allowed)` is given whether the value
/// that was taken last made sense, and what would.
template <Described T, class Source>
void take(T& value, Source& source) {
  detail::take_fields(value, source);
}

namespace detail {

// Takes the numbers of a row as floats.
struct FloatSink {
  std::vector<float>& out;
  void put(double number) { out.push_back(static_cast<float>(number)); }
  void put(std::int64_t number) { out.push_back(static_cast<float>(number)); }
  void put(std::string_view) { out.push_back(std::numeric_limits<float>::quiet_NaN()); }
  void put(std::nullptr_t) { out.push_back(std::numeric_limits<float>::quiet_NaN()); }
};

}  // namespace detail

template <class T>
void put_floats(const T& value, std::vector<float>& out) {
  if constexpr (type_traits::kIsVector<T>) {
    for (const auto& item : value) put_floats(item, out);
  } else if constexpr (Described<T>) {
    detail::FloatSink sink{out};
    put(value, sink);
  } else if constexpr (std::is_arithmetic_v<T>) {
    out.push_back(static_cast<float>(value));
  } else {
    for (int k = 0; k < value.size(); ++k) out.push_back(static_cast<float>(value[k]));
  }
}

}  // namespace skein::columns
