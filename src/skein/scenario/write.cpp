// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "skein/base/time.h"
#include "skein/geo/vec.h"
#include "skein/scenario/numbers.h"

namespace skein::scenario {
namespace {

struct ToNode {
  const void* value;
  const KindTable& kinds;

  template <class M>
  const M& as() const {
    return *static_cast<const M*>(value);
  }

  Node operator()(const NumberType& type) const {
    switch (type.stored) {
      case NumberType::Stored::kRadians:
        return Node::plain(degrees_text(as<double>()));
      case NumberType::Stored::kTime:
        return Node::plain(seconds_text(as<Time>()));
      case NumberType::Stored::kDouble:
        break;
    }
    return Node::plain(number_text(as<double>()));
  }
  Node operator()(const IntegerType& type) const {
    return Node::plain(std::to_string(type.get(value)));
  }
  Node operator()(const BooleanType&) const {
    return Node::plain(as<bool>() ? "true" : "false");
  }
  Node operator()(const TextType&) const { return Node::quoted(as<std::string>()); }
  Node operator()(const FileType&) const { return Node::quoted(as<std::string>()); }
  Node operator()(const WordType& type) const {
    const std::int64_t number = type.get(value);
    const auto word = std::find_if(type.words.begin(), type.words.end(),
                                   [&](const auto& w) { return w.value == number; });
    SKEIN_CHECK(word != type.words.end(), "an enumerator without a word:", number);
    return Node::quoted(word->name);
  }
  Node operator()(const PointType&) const {
    Node list = Node::of(Node::Kind::kList);
    for (const double part : as<Vec2>())
      list.items.push_back(Node::plain(number_text(part)));
    return list;
  }
  Node operator()(const ListType& type) const {
    Node list = Node::of(Node::Kind::kList);
    void* elements = const_cast<void*>(value);  // only ever read
    for (std::size_t i = 0; i < type.size(value); ++i) {
      list.items.push_back(to_node(*type.element, type.at(elements, i), kinds));
    }
    return list;
  }
  Node operator()(const OptionalType& type) const {
    if (!type.has(value)) return Node::of(Node::Kind::kNull);
    return to_node(*type.inner, type.get(const_cast<void*>(value)), kinds);
  }
  Node operator()(const ObjectType& type) const {
    Node map = Node::of(Node::Kind::kMap);
    put_fields(map, *type.object, value);
    return map;
  }
  Node operator()(const ChoiceType& type) const {
    const auto& choice = as<Choice>();
    const Kind* kind = kinds.find(type.role, choice.kind);
    SKEIN_CHECK(kind != nullptr, "unknown kind:", type.role, choice.kind);
    const Object& object = *kind->options;
    if (object.fields.empty()) return Node::quoted(choice.kind);
    Node map = Node::of(Node::Kind::kMap);
    map.put("kind", Node::quoted(choice.kind));
    put_fields(map, object,
               choice.options.has_value()
                   ? object.content(const_cast<std::any&>(choice.options))
                   : object.defaults());
    return map;
  }

  void put_fields(Node& map, const Object& object, const void* members) const {
    SKEIN_CHECK(members != nullptr, "options of another type");
    for (const Field& field : object.fields) {
      map.put(field.key, to_node(*field.type, field.in(members), kinds));
    }
  }
};

// Words that YAML readers of any version take for something else than text.
bool is_special_word(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* word : {"null", "true", "false", "yes", "no", "on", "off", "y", "n"}) {
    if (text == word) return true;
  }
  return false;
}

bool is_safe_plain(const std::string& text) {
  if (text.empty() || is_special_word(text)) return false;
  const auto first = static_cast<unsigned char>(text[0]);
  if (std::isalpha(first) == 0 && first != '_' && first != '/') return false;
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c < 0x80 &&
           (std::isalnum(c) != 0 || c == '_' || c == '/' || c == '.' || c == '-');
  });
}

// In double quotes. Text holds no control characters but tab and line ends (parse.cpp).
// Characters that some reader takes for a line end or drops are written by number.
std::string in_quotes(const std::string& text) {
  struct Escape {
    std::string_view bytes, text;
  };
  static constexpr Escape kEscapes[] = {
      {"\"", "\\\""},
      {"\\", "\\\\"},
      {"\n", "\\n"},
      {"\t", "\\t"},
      {"\r", "\\r"},
      {"\xC2\x85", "\\u0085"},
      {"\xE2\x80\xA8", "\\u2028"},
      {"\xE2\x80\xA9", "\\u2029"},
      {"\xEF\xBB\xBF", "\\uFEFF"},
  };
  std::string quoted = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto* escape =
        std::find_if(std::begin(kEscapes), std::end(kEscapes),
                     [&](const Escape& e) { return rest.starts_with(e.bytes); });
    const bool found = escape != std::end(kEscapes);
    quoted += found ? escape->text : rest.substr(0, 1);
    i += found ? escape->bytes.size() : 1;
  }
  return quoted + '"';
}

std::string scalar_text(const Node& node) {
  if (node.kind == Node::Kind::kNull) return "null";
  if (node.kind == Node::Kind::kPlain || is_safe_plain(node.text)) return node.text;
  return in_quotes(node.text);
}

// Whether the value goes on the line of its key: scalars, and short lists without maps.
bool fits_line(const Node& node, int depth = 0) {
  constexpr std::size_t kMaxItems = 8;
  if (node.items.empty()) return true;
  if (node.kind == Node::Kind::kMap || depth > 1) return false;
  if (node.items.size() > (depth == 0 ? kMaxItems : 3)) return false;
  return std::all_of(node.items.begin(), node.items.end(),
                     [&](const Node& item) { return fits_line(item, depth + 1); });
}

void write_block(const Node& node, std::size_t indent, std::string& out) {
  const std::string spaces(indent, ' ');
  const bool map = node.kind == Node::Kind::kMap;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    out += spaces + (map ? node.keys[i].text + ":" : "-");
    if (fits_line(item)) {
      out += " " + to_inline_yaml(item) + "\n";
    } else if (!map && item.kind == Node::Kind::kMap) {
      std::string inner;  // its first key stands beside the dash
      write_block(item, indent + 2, inner);
      out += " " + inner.substr(indent + 2);
    } else {
      out += "\n";
      write_block(item, indent + 2, out);
    }
  }
}

}  // namespace

Node to_node(const Type& type, const void* value, const KindTable& kinds) {
  return std::visit(ToNode{value, kinds}, type.what);
}

std::string to_inline_yaml(const Node& node) {
  const bool map = node.kind == Node::Kind::kMap;
  if (!map && node.kind != Node::Kind::kList) return scalar_text(node);
  std::string text = map ? "{" : "[";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (map) text += node.keys[i].text + ": ";
    text += to_inline_yaml(node.items[i]);
  }
  return text + (map ? "}" : "]");
}

std::string to_yaml(const Node& node) {
  if (fits_line(node)) return to_inline_yaml(node) + "\n";
  std::string text;
  write_block(node, 0, text);
  return text;
}

}  // namespace skein::scenario
