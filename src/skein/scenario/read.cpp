// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "skein/geo/vec.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/text.h"
#include "skein/scenario/write.h"

namespace skein::scenario {

// Sends each type to its function.
struct ReadVisitor {
  Reader& reader;
  const Node& node;
  void* target;

  template <class Leaf>
  void operator()(const Leaf& type) {
    reader.read_leaf(type, node, target);
  }
  void operator()(const ListType& type) { reader.read_list(type, node, target); }
  void operator()(const OptionalType& type) { reader.read_optional(type, node, target); }
  void operator()(const ObjectType& type) {
    reader.read_object(*type.object, node, target, nullptr, nullptr);
  }
  void operator()(const ChoiceType& type) { reader.read_choice(type, node, target); }
};

void Reader::read(const Type& type, const Node& node, void* target) {
  type_ = &type;
  default_ = has_default_ ? target : nullptr;
  std::visit(ReadVisitor{*this, node, target}, type.what);
}

void Reader::read_list(const ListType& type, const Node& node, void* target) {
  const auto* point = std::get_if<PointType>(&type.element->what);
  if (places_ && point && point->place && node.kind == Node::Kind::kMap)
    return read_feature_list(type, node, target);
  if (node.kind != Node::Kind::kList) return wrong_type(node);
  if (node.patch) return patch_list(type, node, target);
  if (node.items.size() < type.count.at_least || node.items.size() > type.count.at_most) {
    const Type whole{type};
    return error(node.place, fmt::format("{} elements; needs {}.", node.items.size(),
                                         expected(whole)));
  }
  type.clear(target);
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    path_.push_back({nullptr, i});
    has_default_ = false;
    read(*type.element, node.items[i], type.append(target));
    path_.pop_back();
  }
}

void Reader::patch_list(const ListType& type, const Node& node, void* target) {
  // The elements that the patch leaves alone are defaults too.
  for (std::size_t i = 0; i < type.size(target); ++i)
    complete(*type.element, type.at(target, i));
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const auto index = static_cast<std::size_t>(*parse_integer(node.keys[i].text));
    path_.push_back({nullptr, index});
    const std::size_t size = type.size(target);
    if (index > size || index >= type.count.at_most) {
      error(node.items[i].place, fmt::format("the list has {} elements.", size),
            "Elements are counted from 0.");
    } else {
      has_default_ = in_place_ = index < size;
      read(*type.element, node.items[i],
           index < size ? type.at(target, index) : type.append(target));
      in_place_ = false;
    }
    path_.pop_back();
  }
}

void Reader::read_optional(const OptionalType& type, const Node& node, void* target) {
  if (node.kind == Node::Kind::kNull) return type.reset(target);
  const bool had = type.has(target);
  const std::size_t before = problems_.count();
  has_default_ = has_default_ && had;
  read(*type.inner, node, had ? type.get(target) : type.emplace(target));
  if (!had && problems_.count() != before) type.reset(target);
}

void Reader::read_object(const Object& object, const Node& node, void* target,
                         const ChoiceType* choice, const std::string* kind) {
  if (node.kind != Node::Kind::kMap) return wrong_type(node);
  const bool in_place = std::exchange(in_place_, false);
  std::vector<bool> given(object.fields.size(), false);
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    const Node::Key& key = node.keys[i];
    if (choice && key.text == "kind") continue;
    const Field* field = object.find(key.text);
    path_.push_back({&key.text, 0});
    if (!field) {
      field = object.find_former(key.text);
      if (field) renamed(key.place, key.text, field->key);
    }
    if (field && given[static_cast<std::size_t>(field - object.fields.data())]) {
      error(key.place, fmt::format("is given twice, as \"{}\" too.", field->key));
    } else if (field) {
      given[static_cast<std::size_t>(field - object.fields.data())] = true;
      has_default_ = !field->required;
      read(*field->type, node.items[i], field->in(target));
    } else {
      unknown_key(object, key, node.items[i], choice, kind);
    }
    path_.pop_back();
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Field& field = object.fields[i];
    if (given[i]) continue;
    if (field.required && !in_place) {
      path_.push_back({&field.key, 0});
      error(node.place, fmt::format("is missing; needs {}.", expected(*field.type)));
      path_.pop_back();
    } else {
      complete(*field.type, field.in(target));
    }
  }
  apply_rules(object, node, target);
}

namespace {

// The parts of a path: keys, and indices as "[2]".
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (const char c : path) {
    if (c == '.' || c == '[' || parts.empty()) parts.emplace_back();
    if (c != '.') parts.back() += c;
  }
  return parts;
}

// Where the value at `path` was written, or what it would stand in (then not `found`).
Place place_of(const Node& node, const std::string& path, bool& found) {
  found = false;
  const Node* here = &node;
  Place place = node.place;
  for (const std::string& part : parts_of(path)) {
    const bool index = part[0] == '[';
    const std::string text = index ? part.substr(1, part.size() - 2) : part;
    const Node* next = nullptr;
    for (std::size_t i = 0; i < here->items.size(); ++i) {
      // Elements of a list have no keys, but in a patch.
      const bool keyed = i < here->keys.size();
      if ((keyed ? here->keys[i].text : std::to_string(i)) != text) continue;
      next = &here->items[i];
      place = keyed && !index ? here->keys[i].place : next->place;
    }
    if (next == nullptr) return place;
    here = next;
  }
  found = true;
  return place;
}

// Where an error is best mended: its own key, else another one that the file gives.
Place place_of(const Node& node, const RuleViolation& error) {
  bool found = false;
  const Place own = place_of(node, error.key, found);
  if (found) return own;
  for (const std::string& other : error.with) {
    const Place place = place_of(node, other, found);
    if (found && !other.empty()) return place;
  }
  return own;
}

std::string joined(const std::string& path, const std::string& more) {
  return path.empty() || more.empty() || more[0] == '[' ? path + more : path + "." + more;
}

// Whether one of two paths leads through the other.
bool along(const std::string& a, const std::string& b) {
  const std::string& brief = a.size() < b.size() ? a : b;
  const std::string& full = a.size() < b.size() ? b : a;
  return full.starts_with(brief) &&
         (brief.empty() || full.size() == brief.size() || full[brief.size()] == '.' ||
          full[brief.size()] == '[');
}

}  // namespace

bool Reader::faulty(const std::string& path) const {
  return std::any_of(faulty_.begin(), faulty_.end(),
                     [&](const std::string& other) { return along(path, other); });
}

void Reader::apply_rules(const Object& object, const Node& node, const void* target) {
  if (object.rules.empty() || problems_.full() || care_ == Care::kWhatItSays) return;
  const std::string here = path_text();
  std::vector<RuleViolation> found;
  const ValidValues valid(
      [&](const std::string& path) { return !faulty(joined(here, path)); });
  for (const Rule& rule : object.rules)
    for (RuleViolation& error : rule(target, valid)) found.push_back(std::move(error));
  for (const RuleViolation& error : found) {
    const std::string path = joined(here, error.key);
    problems_.add(place_of(node, error), path, error.message);
    faulty_.push_back(path);
  }
}

const Kind* Reader::kind_named(const ChoiceType& type, const Node& name) {
  const std::vector<std::string> names = kinds_.names(type.role);
  if (!name.scalar()) {
    wrong_type(name, fmt::format("Kinds: {}.", any_of(names)));
    return nullptr;
  }
  const Kind* kind = kinds_.find(type.role, name.text);
  if (kind) return kind;
  const std::string near = problems_.full() ? "" : nearest_name(name.text, names);
  std::string hint = near.empty() ? "" : fmt::format("Did you mean \"{}\"? ", near);
  if (const std::string known = kinds_.name_hint(type.role, name.text); !known.empty())
    hint = known + " ";
  hint += names.empty() ? "There is none yet." : fmt::format("Kinds: {}.", any_of(names));
  error(name.place, fmt::format("unknown kind of {}: {}.", type.role, quote(name.text)),
        hint);
  return nullptr;
}

void Reader::read_choice(const ChoiceType& type, const Node& node, void* target) {
  auto& choice = *static_cast<Choice*>(target);
  if (node.kind == Node::Kind::kNull || node.kind == Node::Kind::kList) {
    return wrong_type(node, fmt::format("Kinds: {}.", any_of(kinds_.names(type.role))));
  }
  const Node* name = node.scalar() ? &node : nullptr;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    if (node.keys[i].text == "kind") name = &node.items[i];
  }
  const Kind* kind = nullptr;
  if (name) {
    if (care_ == Care::kWhatItSays && name->scalar() &&
        !kinds_.find(type.role, name->text)) {
      choice = {name->text, {}};
      return;
    }
    kind = kind_named(type, *name);
    if (!kind) return;
    in_place_ = false;
    choice = {kind->name, kind->options->prototype};
  } else if (node.patch && !choice.kind.empty()) {
    complete(Type{type}, target);
    kind = kinds_.find(type.role, choice.kind);
  } else {
    return error(node.place, "has no \"kind\".",
                 fmt::format("Kinds: {}.", any_of(kinds_.names(type.role))));
  }
  const Node no_keys = Node::of(Node::Kind::kMap, node.place);
  read_object(*kind->options, node.scalar() ? no_keys : node,
              kind->options->content(choice.options), &type, &kind->name);
}

namespace {

struct CompleteVisitor {
  Reader& reader;
  const KindTable& kinds;
  void* target;

  template <class Leaf>
  void operator()(const Leaf&) {}
  void operator()(const NumberType& type) {
    if (type.stored != NumberType::Stored::kRadians) return;
    auto& radians = *static_cast<double*>(target);
    if (radians == 0) return;
    radians = geo::radians(parse_number(degrees_text(radians)).value_or(0));
  }
  void operator()(const ListType& type) {
    for (std::size_t i = 0; i < type.size(target); ++i) {
      reader.complete(*type.element, type.at(target, i));
    }
  }
  void operator()(const OptionalType& type) {
    if (type.has(target)) reader.complete(*type.inner, type.get(target));
  }
  void operator()(const ObjectType& type) { all_fields(*type.object, target); }
  void operator()(const ChoiceType& type) {
    auto& choice = *static_cast<Choice*>(target);
    const Kind* kind = kinds.find(type.role, choice.kind);
    SKEIN_CHECK(kind != nullptr, "unknown default kind:", type.role, choice.kind);
    if (!choice.options.has_value()) choice.options = kind->options->prototype;
    all_fields(*kind->options, kind->options->content(choice.options));
  }
  void all_fields(const Object& object, void* members) {
    for (const Field& field : object.fields)
      reader.complete(*field.type, field.in(members));
  }
};

}  // namespace

void Reader::complete(const Type& type, void* target) {
  std::visit(CompleteVisitor{*this, kinds_, target}, type.what);
}

}  // namespace skein::scenario
