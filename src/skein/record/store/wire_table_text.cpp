// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/wire_table_text.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "skein/data/describe/json.h"
#include "skein/data/event/live.h"
#include "skein/record/store/type_name.h"

namespace skein::record {
namespace {

using namespace type_traits;  // NOLINT: the traits are ours

// Something of type T that has an address of its own.
template <class T>
constexpr char kMark = 0;

// Gathers structs, enumerations and choices, each once, under names of their own.
class Table {
 public:
  template <class T>
  std::string type_of() {
    if constexpr (kIsOptional<T>) {
      return type_of<typename T::value_type>() + "?";
    } else if constexpr (kIsVector<T>) {
      return type_of<typename T::value_type>() + "[]";
    } else if constexpr (kIsArray<T>) {
      return fmt::format("{}[{}]", type_of<typename T::value_type>(),
                         std::tuple_size_v<T>);
    } else if constexpr (Described<T>) {
      return "@" + struct_name<T>();
    } else if constexpr (kIsVariant<T>) {
      return "|" + choice_name(static_cast<const T*>(nullptr));
    } else if constexpr (NamedEnum<T>) {
      return "#" + enum_name<T>();
    } else {
      return plain<T>();
    }
  }

  std::string text() const {
    return "// SPDX-License-Identifier: Apache-2.0\n"
           "/** Made by `skein schema wire` from the descriptions in src/skein/data: do "
           "not edit. */\nimport type { Table } from \"./wire\";\n\nexport const kTable: "
           "Table = {\n  version: 1,\n  items: \"LiveItem\",\n  structs: {\n" +
           structs_ + "  },\n  enums: {\n" + enums_ + "  },\n  choices: {\n" + choices_ +
           "  },\n};\n";
  }

  template <class T>
  void add_items() {
    names_[&kMark<T>] = "LiveItem";
    taken_.insert("LiveItem");
    choices_ += choice_text("LiveItem", static_cast<const T*>(nullptr));
  }

 private:
  template <class T>
  static const char* plain() {
    if constexpr (std::is_same_v<T, bool>)
      return "flag";
    else if constexpr (std::is_same_v<T, std::uint8_t>)
      return "u8";
    else if constexpr (std::is_same_v<T, float>)
      return "f32";
    else if constexpr (std::is_same_v<T, double>)
      return "f64";
    else if constexpr (std::is_same_v<T, Time>)
      return "time";
    else if constexpr (std::is_same_v<T, std::string> || WrittenAsName<T>)
      return "text";
    else if constexpr (std::is_same_v<T, Vec2>)
      return "vec2";
    else if constexpr (std::is_same_v<T, Vec3>)
      return "vec3";
    else if constexpr (std::is_same_v<T, Quat>)
      return "quat";
    else if constexpr (kIsId<T> || std::is_unsigned_v<T>)
      return "uint";
    else
      return "int";
  }

  // Whether a name had to be given; `name` is the one that the type has.
  template <class T>
  bool give_name(const std::string& wanted, std::string& name) {
    const auto known = names_.find(&kMark<T>);
    if (known != names_.end()) {
      name = known->second;
      return false;
    }
    name = wanted;
    for (int k = 2; !taken_.insert(name).second; ++k) name = wanted + std::to_string(k);
    names_[&kMark<T>] = name;
    return true;
  }

  template <Described T>
  std::string struct_name() {
    std::string name;
    if (!give_name<T>(type_name(kind_of<T>()), name)) return name;
    std::string fields;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      fields += fmt::format("      [\"{}\", \"{}\"{}],\n", f.name, type_of<M>(),
                            form_text(f.form));
    });
    structs_ += fmt::format("    {}: [\n{}    ],\n", name, fields);
    return name;
  }

  static std::string form_text(const Unit& unit) {
    if (unit.suffix.empty()) return "";
    return unit.factor == 1 ? fmt::format(", \"{}\"", unit.suffix)
                            : fmt::format(", \"{}\", {}", unit.suffix, unit.factor);
  }
  static std::string form_text(const Axes& axes) {
    return fmt::format(", \"{}\", {}, \"{} {} {}\", {}", axes.unit.suffix,
                       axes.unit.factor, axes.names[0], axes.names[1], axes.names[2],
                       axes.third_sign);
  }
  static std::string form_text(Storage) { return ""; }

  template <NamedEnum T>
  std::string enum_name() {
    std::string name;
    if (!give_name<T>("Enum", name)) return name;
    std::string words;
    for (const std::string_view word : names_of(static_cast<const T*>(nullptr)))
      words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", word);
    enums_ += fmt::format("    {}: [{}],\n", name, words);
    return name;
  }

  template <class... Ts>
  std::string choice_name(const std::variant<Ts...>* choice) {
    std::string name;
    if (give_name<std::variant<Ts...>>("Choice", name))
      choices_ += choice_text(name, choice);
    return name;
  }

  template <class... Ts>
  std::string choice_text(const std::string& name, const std::variant<Ts...>*) {
    std::string alternatives;
    const auto add = [&]<class T>() {
      alternatives += fmt::format("      [\"{}\", \"{}\"],\n",
                                  json::alternative_kind<T>(), type_of<T>());
    };
    (add.template operator()<Ts>(), ...);
    return fmt::format("    {}: [\n{}    ],\n", name, alternatives);
  }

  std::map<const char*, std::string> names_;  // by the type's mark
  std::set<std::string> taken_;
  std::string structs_, enums_, choices_;
};

}  // namespace

std::string wire_table_typescript() {
  Table table;
  table.add_items<LiveItem>();
  return table.text();
}

}  // namespace skein::record
