// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/problem.h"

namespace skein::scenario {

/// A value of a scenario file before anybody knows what it means: the tree that reading
/// parses into and writing starts from.
struct Node {
  enum class Kind {
    kNull,   ///< nothing, or `null`
    kPlain,  ///< a word, number or boolean without quotation marks
    kText,   ///< in quotation marks
    kList,
    kMap,
  };

  Kind kind = Kind::kNull;
  /// Made by an override where the file says nothing: it changes the default value
  /// instead of replacing it. A list then has the elements `keys[i].text`, as numbers.
  bool patch = false;
  Place place;
  std::string text;         ///< of kPlain and kText
  std::vector<Node> items;  ///< elements of a list, values of a map

  struct Key {
    std::string text;
    Place place;
  };
  std::vector<Key> keys;  ///< of a map, one per item

  bool scalar() const { return kind == Kind::kPlain || kind == Kind::kText; }

  static Node plain(std::string text) { return leaf(Kind::kPlain, std::move(text)); }
  static Node quoted(std::string text) { return leaf(Kind::kText, std::move(text)); }
  static Node of(Kind kind, const Place& place = {}) {
    Node node;
    node.kind = kind;
    node.place = place;
    return node;
  }
  /// The value of a key of a map; null when it has none.
  const Node* find(std::string_view key) const {
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (keys[i].text == key) return &items[i];
    return nullptr;
  }
  /// Adds an entry to a map.
  Node& put(std::string key, Node value, const Place& where = {}) {
    keys.push_back({std::move(key), where});
    items.push_back(std::move(value));
    return items.back();
  }

 private:
  static Node leaf(Kind kind, std::string text) {
    Node node = of(kind);
    node.text = std::move(text);
    return node;
  }
};

}  // namespace skein::scenario
