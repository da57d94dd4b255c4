// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/type.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/scenario/fields.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/text.h"

namespace skein::scenario {
namespace {

std::string with_range(const std::string& what, const std::string& range) {
  return range.empty() ? what : what + " " + range;
}

// ", at least 3" and the like, to follow "a list".
std::string count_text(const Count& count) {
  const bool high = count.at_most != Count{}.at_most;
  if (count.at_least == 0 && !high) return {};
  if (!high) return fmt::format(", at least {}", count.at_least);
  if (count.at_least == count.at_most) return fmt::format(", exactly {}", count.at_most);
  if (count.at_least == 0) return fmt::format(", at most {}", count.at_most);
  return fmt::format(", {} to {}", count.at_least, count.at_most);
}

struct Expected {
  std::string operator()(const NumberType& t) {
    return with_range("a number", t.range.text());
  }
  std::string operator()(const IntegerType& t) {
    return with_range("a whole number", t.range.text());
  }
  std::string operator()(const BooleanType&) { return "true or false"; }
  std::string operator()(const TextType& t) {
    if (t.utc) return "a moment as 2026-07-01T12:00:00Z";
    return t.allowed.empty() ? "text" : any_of(t.allowed);
  }
  std::string operator()(const WordType& t) {
    std::vector<std::string> names;
    for (const WordType::Word& word : t.words) names.push_back(word.name);
    return any_of(names);
  }
  std::string operator()(const PointType& t) {
    const bool anywhere = t.range.at_least <= -1e7 && t.range.at_most >= 1e7;
    const std::string pair =
        with_range("[north, east]", anywhere ? "" : "each " + t.range.text());
    return t.place ? pair + ", a latitude and longitude or a feature" : pair;
  }
  std::string operator()(const FileType& t) {
    if (t.or_name) return "a name or a .yaml file that exists";
    return std::string(t.folder ? "a folder that exists" : "a file that exists") +
           (t.may_be_empty ? ", or \"\" for none" : "");
  }
  std::string operator()(const ListType& t) {
    return "a list" + count_text(t.count) + ", each " + expected(*t.element);
  }
  std::string operator()(const OptionalType& t) {
    return expected(*t.inner) + ", or null for none";
  }
  std::string operator()(const ObjectType&) { return "keys with values"; }
  std::string operator()(const ChoiceType& t) {
    return fmt::format("the name of a kind of {}, or its keys with \"kind\"", t.role);
  }
};

}  // namespace

bool Range::holds(double value) const {
  return value > above && value >= at_least && value < below && value <= at_most;
}

// An infinite `above` would refuse nothing, as intended: see holds().
std::string Range::text() const {
  const double kInf = std::numeric_limits<double>::infinity();
  std::string low, high;
  if (above > -kInf) low = "above " + number_text(above);
  if (at_least > -kInf) low = "at least " + number_text(at_least);
  if (below < kInf) high = "below " + number_text(below);
  if (at_most < kInf) high = "at most " + number_text(at_most);
  if (at_least > -kInf && at_most < kInf) {
    return "from " + number_text(at_least) + " to " + number_text(at_most);
  }
  return low.empty() || high.empty() ? low + high : low + " and " + high;
}

std::string IntegerRange::text() const {
  const bool low = at_least != IntegerRange{}.at_least;
  const bool high = at_most != IntegerRange{}.at_most;
  if (low && high) return fmt::format("from {} to {}", at_least, at_most);
  if (low) return fmt::format("at least {}", at_least);
  return high ? fmt::format("at most {}", at_most) : std::string();
}

const Field* Object::find(std::string_view key) const {
  for (const Field& field : fields) {
    if (field.key == key) return &field;
  }
  return nullptr;
}

const Field* Object::find_former(std::string_view key) const {
  for (const Field& field : fields)
    if (!field.former.empty() && field.former == key) return &field;
  return nullptr;
}

std::string expected(const Type& type) {
  return std::visit(Expected{}, type.what);
}

void detail::FieldsBase::add(Field field) {
  SKEIN_CHECK(object_.find(field.key) == nullptr, "key described twice:", field.key);
  if (const auto* list = std::get_if<ListType>(&field.type->what)) {
    // Structs are large: a hostile file must not ask for millions.
    const auto& element = list->element->what;
    const bool large = std::holds_alternative<ObjectType>(element) ||
                       std::holds_alternative<ChoiceType>(element);
    object_.fields.push_back(std::move(field));
    if (large) set_count({.at_most = 10000});
    return;
  }
  object_.fields.push_back(std::move(field));
}

void detail::FieldsBase::set_required() {
  SKEIN_CHECK(!object_.fields.empty());
  object_.fields.back().required = true;
}

void detail::FieldsBase::set_former(std::string key) {
  SKEIN_CHECK(!object_.fields.empty());
  SKEIN_CHECK(object_.find(key) == nullptr, "former key is a key:", key);
  object_.fields.back().former = std::move(key);
}

void detail::FieldsBase::set_count(const Count& count) {
  SKEIN_CHECK(!object_.fields.empty());
  Field& field = object_.fields.back();
  Type type = *field.type;
  SKEIN_CHECK(std::holds_alternative<ListType>(type.what), field.key);
  std::get<ListType>(type.what).count = count;
  field.type = std::make_shared<Type>(std::move(type));
}

}  // namespace skein::scenario
