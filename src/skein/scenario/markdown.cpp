// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/markdown.h"

#include <fmt/format.h>

#include "skein/scenario/units.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

constexpr const char* kTableHead =
    "| key | value | default | meaning |\n|---|---|---|---|\n";

// The object that a field's value is or is a list of, and whether it is a list.
struct Below {
  const Object* object = nullptr;
  bool list = false;
};

Below below(const Type& type) {
  if (const auto* nested = std::get_if<ObjectType>(&type.what)) {
    return {nested->object.get(), false};
  }
  if (const auto* optional = std::get_if<OptionalType>(&type.what)) {
    return below(*optional->inner);
  }
  if (const auto* list = std::get_if<ListType>(&type.what)) {
    return {below(*list->element).object, true};
  }
  return {};
}

const ChoiceType* choice_in(const Type& type) {
  if (const auto* list = std::get_if<ListType>(&type.what))
    return choice_in(*list->element);
  if (const auto* optional = std::get_if<OptionalType>(&type.what)) {
    return choice_in(*optional->inner);
  }
  return std::get_if<ChoiceType>(&type.what);
}

std::string escaped(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

std::string default_text(const Type& type, const void* value, const KindTable& kinds) {
  const bool has_choice = choice_in(type) != nullptr;
  if (!has_choice) return "`" + to_inline_yaml(to_node(type, value, kinds)) + "`";
  if (std::holds_alternative<ChoiceType>(type.what)) {
    const auto& kind = static_cast<const Choice*>(value)->kind;
    return kind.empty() ? "" : "`" + kind + "`";
  }
  const auto* list = std::get_if<ListType>(&type.what);
  if (!list) return "";
  std::string names;
  for (std::size_t i = 0; i < list->size(value); ++i) {
    const void* item = list->at(const_cast<void*>(value), i);  // only read
    names += (names.empty() ? "" : ", ") + static_cast<const Choice*>(item)->kind;
  }
  return "`[" + names + "]`";
}

std::string meaning(const Field& field) {
  std::string text = escaped(field.help);
  if (const auto* words = std::get_if<WordType>(&field.type->what)) {
    for (const WordType::Word& word : words->words) {
      text += fmt::format("<br>`{}`: {}", word.name, escaped(word.help));
    }
  }
  return text;
}

std::string row(const Field& field, const void* value, const KindTable& kinds) {
  const auto unit = unit_of(field.key);
  const auto* choice = choice_in(*field.type);
  const std::string what =
      choice ? fmt::format(
                   "{}[{}](#{})",
                   std::holds_alternative<ListType>(field.type->what) ? "list of " : "",
                   choice->role, choice->role)
             : escaped(expected(*field.type));
  return fmt::format(
      "| `{}` | {}{} | {} | {} |\n", field.key, what,
      unit ? fmt::format(" [{}]", unit->symbol) : "",
      field.required ? "required" : default_text(*field.type, value, kinds),
      meaning(field));
}

// The keys of `object` at `path`, then those of the objects below.
void write_object(const std::string& path, const Object& object, const void* value,
                  const KindTable& kinds, std::string& out) {
  out += kTableHead;
  for (const Field& field : object.fields) {
    const Below inner = below(*field.type);
    if (inner.object) {
      out += fmt::format("| `{}` | {} | | {} |\n", field.key,
                         inner.list ? "list of keys, see below" : "keys, see below",
                         escaped(field.help));
    } else {
      out += row(field, field.in(value), kinds);
    }
  }
  for (const Field& field : object.fields) {
    const Below inner = below(*field.type);
    if (!inner.object) continue;
    const bool direct = std::holds_alternative<ObjectType>(field.type->what);
    const std::string name = path + field.key + (inner.list ? "[]" : "");
    out += fmt::format("\n### {}\n\n{}\n\n", name, field.help);
    write_object(name + ".", *inner.object,
                 direct ? field.in(value) : inner.object->defaults(), kinds, out);
  }
}

}  // namespace

std::string keys_as_markdown(const Document& document, const KindTable& kinds) {
  std::string out = document.preface;
  write_object("", *document.keys, document.keys->defaults(), kinds, out);
  if (!kinds.roles().empty()) out += "\n## Kinds\n";
  for (const std::string& role : kinds.roles()) {
    out += fmt::format("\n### {}\n", role);
    for (const Kind& kind : kinds.of(role)) {
      out += fmt::format("\n#### {}: {}\n\n{}\n", role, kind.name, kind.help);
      if (kind.options->fields.empty()) continue;
      out += "\n";
      write_object(kind.name + ".", *kind.options, kind.options->defaults(), kinds, out);
    }
  }
  return out;
}

}  // namespace skein::scenario
