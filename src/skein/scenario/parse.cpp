// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/parse.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <map>
#include <numeric>
#include <streambuf>
#include <string>
#include <utility>

#include "skein/scenario/text.h"

namespace skein::scenario {
namespace {

// A limit was passed or a construct refused: nothing after it can be trusted.
struct Refused {
  YAML::Mark mark;
  std::string message;
};

// A stream over text that stands elsewhere, without a copy.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* start = const_cast<char*>(text.data());  // only ever read
    setg(start, start, start + text.size());
  }
};

std::size_t count_values(const Node& node) {
  std::size_t count = 1;
  for (const Node& item : node.items) count += count_values(item);
  return count;
}

// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::int32_t source, Problems& problems)
      : source_(source), problems_(problems) {}

  std::optional<Node> take_root() { return std::exchange(root_, std::nullopt); }
  Place place(const YAML::Mark& mark) const {
    if (mark.is_null()) return {source_, 1, 1};
    return {source_, mark.line + 1, mark.column + 1};
  }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    count(mark);
    finish(Node::of(Node::Kind::kNull, place(mark)), anchor, mark);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    count(mark);
    // The parser marks a plain scalar with the tag "?", a quoted one with "!".
    Node node =
        Node::of(tag == "?" ? Node::Kind::kPlain : Node::Kind::kText, place(mark));
    node.text = value;
    if (first_bad_byte(value)) {
      throw Refused{mark, quote(value) + " holds a control character or is not UTF-8."};
    }
    finish(std::move(node), anchor, mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                       YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    open(Node::Kind::kList, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Node::Kind::kMap, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw Refused{mark, "the alias stands inside the value that it refers to."};
    }
    Node copy = found->second;
    count_copy(mark, copy);
    finish(std::move(copy), 0, mark);
  }

 private:
  struct Open {
    Node node;
    YAML::anchor_t anchor = 0;
    YAML::Mark mark;
    bool has_key = false;    // of a map: a key waits for its value
    bool drop_next = false;  // of a map: the waiting key is not valid
  };

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    throw Refused{mark, fmt::format("the tag {} is not used here.", quote(tag))};
  }
  void count(const YAML::Mark& mark) {
    if (++values_ <= ParseLimits::kValues) return;
    throw Refused{mark, fmt::format("more than {} values.", ParseLimits::kValues)};
  }
  void count_copy(const YAML::Mark& mark, const Node& node) {
    copied_ += count_values(node);
    if (copied_ <= ParseLimits::kCopiedValues) return;
    throw Refused{mark, fmt::format("anchors and aliases repeat more than {} values.",
                                    ParseLimits::kCopiedValues)};
  }

  void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    refuse_tag(mark, tag);
    count(mark);
    if (stack_.size() >= ParseLimits::kDepth) {
      throw Refused{mark, fmt::format("nested more than {} deep.", ParseLimits::kDepth)};
    }
    Open level;
    level.node = Node::of(kind, place(mark));
    level.anchor = anchor;
    level.mark = mark;
    stack_.push_back(std::move(level));
  }

  void close() {
    Open level = std::move(stack_.back());
    stack_.pop_back();
    if (level.node.kind == Node::Kind::kMap) drop_repeated(level.node);
    finish(std::move(level.node), level.anchor, level.mark);
  }

  // Puts a finished value where it belongs.
  void finish(Node node, YAML::anchor_t anchor, const YAML::Mark& mark) {
    if (anchor != 0) {
      count_copy(mark, node);
      anchors_[anchor] = node;
    }
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& level = stack_.back();
    if (level.node.kind == Node::Kind::kList) {
      level.node.items.push_back(std::move(node));
    } else if (level.has_key) {
      level.has_key = false;
      if (std::exchange(level.drop_next, false)) return;
      level.node.items.push_back(std::move(node));
    } else {
      level.has_key = true;
      if (!node.scalar()) {
        problems_.add(node.place, "", "a key must be a word.");
        level.drop_next = true;
        return;
      }
      level.node.keys.push_back({std::move(node.text), node.place});
    }
  }

  // Reports keys that stand twice in one map and keeps the first.
  void drop_repeated(Node& map) {
    std::vector<std::size_t> order(map.keys.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return map.keys[a].text < map.keys[b].text;
    });
    std::vector<bool> repeated(order.size(), false);
    bool any = false;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
      const Node::Key& key = map.keys[order[i]];
      const Node::Key& earlier = map.keys[order[first]];
      if (key.text != earlier.text) {
        first = i;
        continue;
      }
      problems_.add(key.place, "",
                    fmt::format("the key {} stands here a second time; first in line {}.",
                                quote(key.text), earlier.place.line),
                    "Remove one of the two.");
      repeated[order[i]] = any = true;
    }
    if (!any) return;
    Node kept = Node::of(Node::Kind::kMap, map.place);
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
      if (repeated[i]) continue;
      kept.put(std::move(map.keys[i].text), std::move(map.items[i]), map.keys[i].place);
    }
    map = std::move(kept);
  }

  std::int32_t source_;
  Problems& problems_;
  std::vector<Open> stack_;
  std::map<YAML::anchor_t, Node> anchors_;
  std::optional<Node> root_;
  std::size_t values_ = 0;
  std::size_t copied_ = 0;
};

Place place_of_byte(std::string_view text, std::size_t offset, std::int32_t source) {
  const std::string_view before = text.substr(0, offset);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {source, static_cast<std::int32_t>(lines + 1),
          static_cast<std::int32_t>(offset - start + 1)};
}

// The library calls a tab in the indentation many things; the user wants to know.
bool has_tab_indent(std::string_view text, int line) {
  std::size_t start = 0;
  for (int i = 1; i < line && start != std::string_view::npos; ++i) {
    start = text.find('\n', start);
    if (start != std::string_view::npos) ++start;
  }
  if (start == std::string_view::npos) return false;
  const std::size_t end = text.find_first_not_of(" \t", start);
  return text.substr(start, end == std::string_view::npos ? end : end - start)
             .find('\t') != std::string_view::npos;
}

std::string capitalised(std::string_view text) {
  std::string out(text);
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z')
    out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out;
}

bool text_is_valid(std::string_view text, std::int32_t source, std::string_view name,
                   Problems& problems) {
  if (text.size() > ParseLimits::kBytes) {
    problems.add(
        {source, 0, 0}, "",
        fmt::format("{} bytes; at most {} are read.", text.size(), ParseLimits::kBytes));
    return false;
  }
  if (const auto bad = first_bad_byte(text)) {
    problems.add(
        place_of_byte(text, *bad, source), "",
        fmt::format("byte 0x{:02x} is not text.", static_cast<unsigned char>(text[*bad])),
        fmt::format("{} is a YAML file in UTF-8.", capitalised(name)));
    return false;
  }
  return true;
}

}  // namespace

std::optional<Node> parse_yaml(std::string_view text, std::int32_t source,
                               std::string_view name, Problems& problems) {
  if (!text_is_valid(text, source, name, problems)) return std::nullopt;
  TreeBuilder builder(source, problems);
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) return std::nullopt;
    std::optional<Node> root = builder.take_root();
    if (parser.HandleNextDocument(builder)) {
      const auto second = builder.take_root();
      problems.add(
          second ? second->place : Place{source, 1, 1}, "",
          fmt::format("a second document starts here; {} is one document.", name));
    }
    return root;
  } catch (const Refused& refused) {
    problems.add(builder.place(refused.mark), "", refused.message);
  } catch (const YAML::Exception& error) {
    const Place place = builder.place(error.mark);
    const bool tab = has_tab_indent(text, place.line);
    problems.add(place, "", fmt::format("not YAML: {}.", error.msg),
                 tab ? "The line is indented with a tab; use spaces." : "");
  }
  return std::nullopt;
}

}  // namespace skein::scenario
