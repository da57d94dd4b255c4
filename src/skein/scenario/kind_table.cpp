// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/kind_table.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/scenario/read.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

// What a list or optional is made of; the type itself when it is neither.
const Type& innermost(const Type& type) {
  if (const auto* list = std::get_if<ListType>(&type.what))
    return innermost(*list->element);
  if (const auto* optional = std::get_if<OptionalType>(&type.what)) {
    return innermost(*optional->inner);
  }
  return type;
}

bool holds_choice(const Type& type) {
  const Type& inner = innermost(type);
  if (const auto* nested = std::get_if<ObjectType>(&inner.what)) {
    return std::any_of(nested->object->fields.begin(), nested->object->fields.end(),
                       [](const Field& field) { return holds_choice(*field.type); });
  }
  return std::holds_alternative<ChoiceType>(inner.what);
}

}  // namespace

void check_defaults(const std::string& name, const Object& object) {
  const KindTable no_kinds;
  Problems problems({name});
  for (const Field& field : object.fields) {
    if (const auto* nested = std::get_if<ObjectType>(&innermost(*field.type).what)) {
      check_defaults(name + "." + field.key, *nested->object);
    }
    // Required keys need no sensible default; choices need the finished table.
    if (field.required || holds_choice(*field.type)) continue;
    std::any copy = object.prototype;
    Node node = to_node(*field.type, field.in(object.defaults()), no_kinds);
    Reader(no_kinds, {}, nullptr, problems)
        .read(*field.type, node, field.in(object.content(copy)));
    const std::vector<Problem> found = problems.take();
    SKEIN_CHECK(found.empty(), "bad default:", name, field.key, found.front().text());
  }
}

void KindTable::add_kind(const std::string& role, Kind kind) {
  SKEIN_CHECK(find(role, kind.name) == nullptr, "kind added twice:", role, kind.name);
  check_defaults(role + " " + kind.name, *kind.options);
  kinds_[role].push_back(std::move(kind));
}

const std::vector<Kind>& KindTable::of(std::string_view role) const {
  static const std::vector<Kind> kNone;
  const auto found = kinds_.find(role);
  return found == kinds_.end() ? kNone : found->second;
}

const Kind* KindTable::find(std::string_view role, std::string_view name) const {
  for (const Kind& kind : of(role)) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::vector<std::string> KindTable::names(std::string_view role) const {
  std::vector<std::string> names;
  for (const Kind& kind : of(role)) names.push_back(kind.name);
  return names;
}

std::vector<std::string> KindTable::roles() const {
  std::vector<std::string> roles;
  for (const auto& [role, kinds] : kinds_) roles.push_back(role);
  return roles;
}

Choice default_choice(const KindTable& kinds, std::string_view role,
                      std::string_view name) {
  Choice choice{std::string(name), {}};
  Problems unused({"defaults"});
  Reader(kinds, {}, nullptr, unused)
      .complete(Type{ChoiceType{std::string(role)}}, &choice);
  return choice;
}

}  // namespace skein::scenario
