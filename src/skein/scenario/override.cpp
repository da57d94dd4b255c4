// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/scenario/numbers.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/text.h"

namespace skein::scenario {
namespace {

using Step = std::variant<std::string, std::size_t>;  // a key or an index

// "a.b[2].c" as steps; nothing when it is no such path.
std::optional<std::vector<Step>> parse_path(std::string_view path) {
  constexpr std::size_t kMaxDigits = 9;
  std::vector<Step> steps;
  while (!path.empty()) {
    if (path[0] == '[') {
      const std::size_t end = path.find(']');
      if (steps.empty() || end == path.npos || end < 2 || end > kMaxDigits) return {};
      const auto index = parse_integer(path.substr(1, end - 1));
      if (!index || *index < 0) return {};
      steps.emplace_back(static_cast<std::size_t>(*index));
      path.remove_prefix(end + 1);
    } else {
      if (!steps.empty()) {
        if (path[0] != '.') return {};
        path.remove_prefix(1);
      }
      const std::size_t end = std::min(path.find_first_of(".[]"), path.size());
      if (end == 0) return {};
      steps.emplace_back(std::string(path.substr(0, end)));
      path.remove_prefix(end);
    }
  }
  if (steps.empty() || steps.size() > ParseLimits::kDepth) return {};
  return steps;
}

// The places of a parsed override: it has no lines.
void set_place(Node& node, const Place& place) {
  node.place = place;
  for (Node::Key& key : node.keys) key.place = place;
  for (Node& item : node.items) set_place(item, place);
}

Node& entry(Node& map, const std::string& key, const Place& place) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text == key) return map.items[i];
  }
  return map.put(key, Node::of(Node::Kind::kNull, place), place);
}

void become(Node& node, Node::Kind kind, const Place& place) {
  node = Node::of(kind, place);
  node.patch = true;
}

// The value that `step` leads to, made when it is absent; null and a problem when `node`
// cannot have it.
Node* follow(Node& node, const Step& step, const Place& place, Problems& problems) {
  using enum Node::Kind;
  if (const auto* key = std::get_if<std::string>(&step)) {
    if (node.kind == kNull) become(node, kMap, place);
    if (node.scalar()) {  // `wind: calm` is short for `wind: {kind: calm}`
      Node kind = node;
      node = Node::of(kMap, node.place);
      node.put("kind", std::move(kind), node.place);
    }
    if (node.kind == kMap) return &entry(node, *key, place);
    problems.add(place, "", "a list stands here; write an index as in [0].");
    return nullptr;
  }
  const std::size_t index = std::get<std::size_t>(step);
  if (node.kind == kNull) become(node, kList, place);
  if (node.kind != kList) {
    problems.add(place, "", fmt::format("no list stands here for [{}].", index));
    return nullptr;
  }
  if (node.patch) return &entry(node, std::to_string(index), place);
  if (index > node.items.size()) {
    problems.add(place, "", fmt::format("the list has {} elements.", node.items.size()),
                 "Elements are counted from 0.");
    return nullptr;
  }
  if (index == node.items.size()) node.items.push_back(Node::of(kNull, place));
  return &node.items[index];
}

}  // namespace

void apply_override(const Override& change, std::int32_t source, Node& root,
                    Problems& problems) {
  const Place place{source, 0, 0};
  if (first_bad_byte(change.text)) {
    return problems.add(place, "", "holds bytes that are not text.");
  }
  const std::size_t equals = change.text.find('=');
  const std::string_view path = std::string_view(change.text).substr(0, equals);
  const auto steps = equals == change.text.npos ? std::nullopt : parse_path(path);
  if (!steps) {
    return problems.add(place, "", "needs the form key.key[0].key=value.");
  }
  const std::size_t before = problems.count();
  std::optional<Node> value = parse_yaml(std::string_view(change.text).substr(equals + 1),
                                         source, "a value", problems);
  if (problems.count() != before) return;
  if (!value) value = Node::of(Node::Kind::kNull);
  set_place(*value, place);
  Node* target = &root;
  for (const Step& step : *steps) {
    target = follow(*target, step, place, problems);
    if (!target) return;
  }
  *target = std::move(*value);
}

}  // namespace skein::scenario
