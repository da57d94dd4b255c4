// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "skein/data/describe/json.h"
#include "skein/data/team/task_form.h"
#include "skein/data/team/task_value.h"
#include "skein/data/team/task_words.h"

/// The form of a kind of task, by the description of its values. Includes all of the JSON
/// library: for source files that add kinds.
namespace skein {

namespace task_page {

using namespace type_traits;  // NOLINT: the traits are ours
using Json = nlohmann::ordered_json;

template <class M>
inline constexpr bool kIsPlaceList = false;
template <>
inline constexpr bool kIsPlaceList<std::vector<Vec2>> = true;

inline Json field_of(std::string name, const char* type, std::string_view help) {
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

inline Json integer(const std::string& name, std::string_view help, Json value) {
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
Json form_of(const std::string& usage) {
  Json fields = Json::array();
  const T value{};
  for_each_field<T>([&](const auto& f) {
    add_field(fields, std::string(f.name), f.form, f.help, value.*f.member);
  });
  return Json{{"kind", kind_of<T>()},
              {"help", kDescription<T>.help},
              {"syntax", usage},
              {"fields", std::move(fields)}};
}

}  // namespace task_page

/// How tasks of a kind are written.
/// @tparam T  a described struct, with check_task() and needs_of_task() beside it where
///            its description does not say all (task_facts.h).
template <Described T>
TaskForm task_form_of() {
  TaskForm form;
  form.kind = kind_of<T>();
  form.help = kDescription<T>.help;
  form.usage = task_words::usage_of<T>();
  form.plain = as_task(T{});
  form.parse = [](TaskForm::Words words) -> Result<TaskText> {
    auto text = task_words::Filler<T>().fill(words);
    // Names become numbers, and files plans, later.
    if (!text || !text.value().file.empty() || !text.value().others.empty()) return text;
    if (std::string error = value_error(*task_as<T>(text.value().what)); !error.empty())
      return Error{ErrorCode::kBadInput, "", std::move(error), ""};
    return text;
  };
  form.from_json = [](const json::Json& values) -> Result<TaskKind> {
    auto read = json::from_json<T>(values);
    if (!read) return read.error();
    return as_task(std::move(read).value());
  };
  form.error = [](const TaskKind& task) -> std::string {
    const auto values = task_as<T>(task);
    return values ? value_error(*values) : "its values cannot be read.";
  };
  // A plan is drawn elsewhere and comes from a file.
  if constexpr (!std::is_same_v<T, FlyPlan>)
    form.page_form = [usage = form.usage] { return task_page::form_of<T>(usage); };
  return form;
}

}  // namespace skein
