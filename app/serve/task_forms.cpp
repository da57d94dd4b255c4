// SPDX-License-Identifier: Apache-2.0
#include "app/serve/task_forms.h"

#include <string>

#include "skein/data/describe/json.h"
#include "skein/data/team/task.h"
#include "skein/data/team/task_text.h"

namespace skein::serve {
namespace {

using namespace type_traits;  // NOLINT: the traits are ours
using Json = nlohmann::ordered_json;

template <class M>
constexpr bool kIsPlaceList = false;
template <>
constexpr bool kIsPlaceList<std::vector<Vec2>> = true;

Json field_of(std::string name, const char* type, std::string_view help) {
  return Json{{"name", std::move(name)}, {"type", type}, {"help", help}};
}

// A number with its unit, that may be left out where `is_optional`.
template <class Form>
Json number(const std::string& name, const Form& form, std::string_view help,
            bool is_optional, double value) {
  Json field =
      field_of(name + std::string(json::detail::suffix_of(form)), "number", help);
  const std::string_view suffix = json::detail::suffix_of(form);
  field["unit"] = suffix.empty() ? suffix : suffix.substr(1);
  field["optional"] = is_optional;
  field["default"] =
      is_optional ? Json(nullptr) : Json(value * json::detail::factor_of(form));
  return field;
}

Json integer(const std::string& name, std::string_view help, Json value) {
  Json field = field_of(name, "integer", help);
  field["optional"] = value.is_null();
  field["default"] = std::move(value);
  return field;
}

// One field as a form shows it; fields that no person fills in are left out: plans, holes
// of areas, and what is left of a task.
template <class M, class Form>
void add_field(Json& fields, const std::string& name, const Form& form,
               std::string_view help, const M& value) {
  if constexpr (std::is_same_v<M, Vec2>) {
    const std::string_view first = form.names[0];
    if (first == "north" && form.unit.suffix == unit::kMetre.suffix) {
      fields.push_back(field_of(name, "place", help));
      return;
    }
    for (int k = 0; k < 2; ++k)
      fields.push_back(
          number(json::joined(name, form.names[k]), form.unit, help, false, value[k]));
  } else if constexpr (kIsPlaceList<M>) {
    if (name == "lines") return;
    Json field = field_of(name, "places", help);
    field["shape"] = name == "area" ? "area" : "line";
    fields.push_back(std::move(field));
  } else if constexpr (std::is_same_v<M, double>) {
    fields.push_back(number(name, form, help, false, value));
  } else if constexpr (std::is_same_v<M, std::optional<double>>) {
    fields.push_back(number(name, form, help, true, 0));
  } else if constexpr (std::is_same_v<M, Time>) {
    fields.push_back(number(json::joined(name, "s"), unit::kNone, help, false, 0));
  } else if constexpr (std::is_same_v<M, bool>) {
    Json field = field_of(name, "flag", help);
    field["default"] = value;
    fields.push_back(std::move(field));
  } else if constexpr (NamedEnum<M>) {
    Json field = field_of(name, "word", help);
    for (const std::string_view word : names_of(static_cast<const M*>(nullptr)))
      field["words"].push_back(word);
    field["default"] = name_of(value);
    fields.push_back(std::move(field));
  } else if constexpr (kIsId<M>) {
    fields.push_back(field_of(name, "aircraft", help));
  } else if constexpr (std::is_same_v<M, std::vector<EntityId>>) {
    fields.push_back(field_of(name, "aircraft_list", help));
  } else if constexpr (std::is_integral_v<M>) {
    fields.push_back(integer(name, help, value));
  } else if constexpr (kIsOptional<M>) {
    if constexpr (std::is_integral_v<typename M::value_type>)
      fields.push_back(integer(name, help, nullptr));
  }
}

template <Described T>
Json form_of(const std::string& syntax) {
  Json fields = Json::array();
  const T value{};
  for_each_field<T>([&](const auto& f) {
    add_field(fields, std::string(f.name), f.form, f.help, value.*f.member);
  });
  return Json{{"kind", kind_of<T>()},
              {"help", kDescription<T>.help},
              {"syntax", syntax},
              {"fields", std::move(fields)}};
}

}  // namespace

Json task_forms() {
  Json forms = Json::array();
  const auto usage = task_usage();  // in the order of the kinds
  std::size_t k = 0;
  for_each_alternative(static_cast<const TaskKind*>(nullptr), [&]<class T>() {
    // A plan is drawn elsewhere and comes from a file.
    const std::string& syntax = usage.at(k++).first;
    if constexpr (!std::is_same_v<T, FlyPlan>) forms.push_back(form_of<T>(syntax));
  });
  return forms;
}

}  // namespace skein::serve
