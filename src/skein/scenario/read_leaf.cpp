// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "skein/base/time.h"
#include "skein/data/command/command_text.h"
#include "skein/data/team/task_text.h"
#include "skein/geo/vec.h"
#include "skein/scenario/numbers.h"
#include "skein/scenario/read.h"
#include "skein/scenario/text.h"
#include "skein/scenario/units.h"
#include "skein/scenario/utc.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

std::string found_text(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return "nothing";
    case Node::Kind::kPlain:
      return parse_number(node.text) ? node.text : quote(node.text);
    case Node::Kind::kText:
      return "the text " + quote(node.text);
    case Node::Kind::kList:
      return "a list";
    case Node::Kind::kMap:
      return "keys with values";
  }
  return {};
}

bool is_whole(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

std::optional<double> Reader::number(const Node& node, const Range& range) {
  const auto value =
      node.kind == Node::Kind::kPlain ? parse_number(node.text) : std::nullopt;
  if (!value) {
    const bool in_quotes = node.kind == Node::Kind::kText && parse_number(node.text);
    const bool has_unit = node.scalar() && !node.text.empty() &&
                          (std::isdigit(static_cast<unsigned char>(node.text[0])) != 0);
    const auto unit = unit_of(last_key());
    wrong_type(node,
               in_quotes ? "Remove the quotation marks."
               : has_unit && unit
                   ? fmt::format("Write the number alone; the key says the unit, {}.",
                                 unit->symbol)
                   : "");
    return std::nullopt;
  }
  if (!std::isfinite(*value)) {
    error(node.place, fmt::format("{} must be a finite number.", node.text),
          default_hint());
    return std::nullopt;
  }
  if (!range.holds(*value)) {
    out_of_range(node, range.text());
    return std::nullopt;
  }
  return value;
}

void Reader::read_leaf(const NumberType& type, const Node& node, void* target) {
  const auto value = number(node, type.range);
  if (!value) return;
  switch (type.stored) {
    case NumberType::Stored::kDouble:
      *static_cast<double*>(target) = *value;
      break;
    case NumberType::Stored::kRadians:
      *static_cast<double*>(target) = geo::radians(*value);
      break;
    case NumberType::Stored::kTime:
      *static_cast<Time*>(target) = Time::from_seconds(*value);
      break;
  }
}

void Reader::read_leaf(const IntegerType& type, const Node& node, void* target) {
  const bool plain = node.kind == Node::Kind::kPlain;
  const auto value = plain ? parse_integer(node.text) : std::nullopt;
  if (!value && plain && is_whole(node.text))  // a whole number beyond 64 bits
    return out_of_range(
        node, fmt::format("from {} to {}", type.range.at_least, type.range.at_most));
  if (!value) {
    const bool in_quotes = node.kind == Node::Kind::kText && parse_integer(node.text);
    return wrong_type(node, in_quotes ? "Remove the quotation marks." : default_hint());
  }
  if (*value < type.range.at_least || *value > type.range.at_most) {
    return out_of_range(node, type.range.text());
  }
  type.set(target, *value);
}

void Reader::read_leaf(const BooleanType&, const Node& node, void* target) {
  const bool yes = node.text == "true" || node.text == "True";
  const bool no = node.text == "false" || node.text == "False";
  if (node.kind != Node::Kind::kPlain || (!yes && !no)) return wrong_type(node);
  *static_cast<bool*>(target) = yes;
}

void Reader::read_leaf(const TextType& type, const Node& node, void* target) {
  constexpr std::size_t kLongest = 4096;
  if (!node.scalar()) return wrong_type(node);
  if (node.text.size() > kLongest) {
    return error(node.place, fmt::format("{} bytes of text; at most {} are allowed.",
                                         node.text.size(), kLongest));
  }
  if (type.utc && !parse_utc(node.text)) return wrong_type(node, default_hint());
  const auto& allowed = type.allowed;
  if (!allowed.empty() &&
      std::find(allowed.begin(), allowed.end(), node.text) == allowed.end()) {
    const std::string near = nearest_name(node.text, allowed);
    return wrong_type(node,
                      near.empty() ? "" : fmt::format("Did you mean \"{}\"?", near));
  }
  auto& text = *static_cast<std::string*>(target);
  text = node.text;
  const bool is_first = !path_.empty() && !path_.back().key && path_.back().index == 0;
  if (std::string wrong = order_error(type, node.text); !wrong.empty())
    return error(node.place, std::move(wrong));
  const bool is_order = type.says == TextType::Says::kCommand;
  if (!is_order && !(type.program && is_first)) return;
  const auto& folder = folders_.of(node.place);
  NamedPath named =
      is_order ? find_file_of_order(node.text, folder) : find_program(node.text, folder);
  if (!named.problem.empty() && care_ == Care::kAll)
    return error(node.place, std::move(named.problem), std::move(named.hint));
  text = std::move(named.path);
}

std::string Reader::order_error(const TextType& type, const std::string& text) const {
  if (care_ == Care::kWhatItSays) return {};
  const auto reason = [](const auto& parsed) {
    return parsed ? std::string() : parsed.error().text();
  };
  switch (type.says) {
    case TextType::Says::kAnything:
      break;
    case TextType::Says::kCommand:
      return reason(parse_command(text, kinds_.task_forms()));
    case TextType::Says::kTask:
      return text.empty() ? "" : reason(parse_task(text, kinds_.task_forms()));
  }
  return {};
}

void Reader::read_leaf(const WordType& type, const Node& node, void* target) {
  std::vector<std::string> names;
  for (const WordType::Word& word : type.words) {
    if (node.scalar() && node.text == word.name) return type.set(target, word.value);
    if (node.scalar() && !word.former.empty() && node.text == word.former) {
      renamed(node.place, node.text, word.name);
      return type.set(target, word.value);
    }
    names.push_back(word.name);
  }
  const std::string near = node.scalar() ? nearest_name(node.text, names) : "";
  wrong_type(node,
             near.empty() ? default_hint() : fmt::format("Did you mean \"{}\"?", near));
}

void Reader::read_leaf(const PointType& type, const Node& node, void* target) {
  if (places_ && type.place && node.kind == Node::Kind::kMap && !node.patch) {
    const auto there = place(node);
    if (!there) return;
    for (const double part : *there)
      if (!type.range.holds(part))
        return error(node.place,
                     fmt::format("lies {:.0f} m north, {:.0f} m east of the origin; each "
                                 "must be {}.",
                                 there->x(), there->y(), type.range.text()));
    *static_cast<Vec2*>(target) = *there;
    return;
  }
  if (node.kind != Node::Kind::kList || node.patch || node.items.size() != 2) {
    return wrong_type(node, node.kind == Node::Kind::kList
                                ? fmt::format("It has {} elements.", node.items.size())
                                : default_hint());
  }
  const auto north = number(node.items[0], type.range);
  const auto east = number(node.items[1], type.range);
  if (north && east) *static_cast<Vec2*>(target) = {*north, *east};
}

void Reader::read_leaf(const FileType& type, const Node& node, void* target) {
  auto& member = *static_cast<std::string*>(target);
  if (!node.scalar()) {
    return wrong_type(node, type.may_be_empty ? "Write \"\" for none." : "");
  }
  if (node.text.empty()) {
    if (!type.may_be_empty) return wrong_type(node);
    member.clear();
    return;
  }
  if (type.or_name && !names_yaml_file(node.text)) {
    member = node.text;
    return;
  }
  NamedPath named = find_file(node.text, folders_.of(node.place), type);
  if (!named.problem.empty() && care_ == Care::kAll)
    return error(node.place, std::move(named.problem), std::move(named.hint));
  member = std::move(named.path);
}

void Reader::error(const Place& place, std::string message, std::string hint) {
  if (problems_.full()) return problems_.add(place, "", "");
  faulty_.push_back(path_text());
  problems_.add(place, faulty_.back(), std::move(message), std::move(hint));
}

void Reader::wrong_type(const Node& node, std::string hint) {
  error(node.place,
        fmt::format("found {}, needs {}.", found_text(node), expected(*type_)),
        std::move(hint));
}

void Reader::out_of_range(const Node& node, const std::string& range) {
  error(node.place, fmt::format("{} must be {}.", node.text, range), default_hint());
}

void Reader::renamed(const Place& place, const std::string& from, const std::string& to) {
  problems_.note({place, from, to});
  if (care_ == Care::kWhatItSays) return;
  error(place, fmt::format("\"{}\" is called \"{}\" now.", from, to),
        place.source == 0 ? "`skein check --update FILE` rewrites the file." : "");
}

void Reader::unknown_key(const Object& object, const Node::Key& key, const Node& value,
                         const ChoiceType* choice, const std::string* kind) {
  if (problems_.full()) return error(key.place, "");
  std::vector<std::string> known;
  if (choice) known.emplace_back("kind");
  for (const Field& field : object.fields) known.push_back(field.key);
  std::string hint = unit_advice(key.text, value.text, known);
  if (hint.empty()) {
    const std::string near = nearest_name(key.text, known);
    if (!near.empty()) hint = fmt::format("Did you mean \"{}\"?", near);
  }
  if (hint.empty() && choice) {
    for (const Kind& other : kinds_.of(choice->role)) {
      if (!other.options->find(key.text)) continue;
      hint = fmt::format("The kind \"{}\" has it, \"{}\" has not.", other.name, *kind);
      break;
    }
  }
  if (hint.empty()) {
    hint = known.empty() ? "No keys stand here."
                         : fmt::format("Known here: {}.", fmt::join(known, ", "));
  }
  error(key.place, "unknown key.", std::move(hint));
}

std::string Reader::default_hint() const {
  if (!default_) return {};
  const auto& what = type_->what;
  if (std::holds_alternative<ObjectType>(what) ||
      std::holds_alternative<ListType>(what) ||
      std::holds_alternative<ChoiceType>(what)) {
    return {};
  }
  const std::string text = to_inline_yaml(to_node(*type_, default_, kinds_));
  return text == "\"\"" ? "" : fmt::format("The default is {}.", text);
}

std::string Reader::path_text() const {
  constexpr std::size_t kLongestKey = 80;
  std::string text;
  for (const Step& step : path_) {
    if (!step.key) {
      text += fmt::format("[{}]", step.index);
      continue;
    }
    if (!text.empty()) text += ".";
    const std::string quoted = quote(*step.key);
    const bool plain =
        step.key->size() <= kLongestKey && quoted.size() == step.key->size() + 2;
    text += plain ? *step.key : quoted;
  }
  return text;
}

std::string Reader::last_key() const {
  for (auto step = path_.rbegin(); step != path_.rend(); ++step) {
    if (step->key) return *step->key;
  }
  return {};
}

}  // namespace skein::scenario
