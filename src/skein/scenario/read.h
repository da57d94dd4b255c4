// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/file_path.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/node.h"
#include "skein/scenario/places.h"
#include "skein/scenario/problem.h"
#include "skein/scenario/type.h"

namespace skein::scenario {

/// Turns trees into values, by their description, and reports every validation error that
/// it meets.
class Reader {
 public:
  /// How much is asked of a file.
  enum class Care {
    kAll,        ///< all of it is to be used
    kWhatItSays  ///< what is not here, kinds and files, stays a name; no rule is applied
  };

  /// @param places  besides local metres; null: none.
  Reader(const KindTable& kinds, Folders folders, const Places* places,
         Problems& problems, Care care = Care::kAll)
      : kinds_(kinds),
        folders_(std::move(folders)),
        places_(places),
        problems_(problems),
        care_(care) {}

  /// Reads `node` into `target`, whose content counts as the default: what the tree does
  /// not say stays. Where errors are reported, the target holds something harmless.
  void read(const Type& type, const Node& node, void* target);

  /// What read() does to a value that the file does not mention: fills in the options of
  /// choices, and rounds angles to those that a file can say, so that a run and a repeat
  /// from its written-out scenario have the same bits.
  void complete(const Type& type, void* target);

 private:
  struct Step {  // one part of a key path: a key, or an index when `key` is null
    const std::string* key = nullptr;
    std::size_t index = 0;
  };
  friend struct ReadVisitor;

  void read_leaf(const NumberType& type, const Node& node, void* target);
  void read_leaf(const IntegerType& type, const Node& node, void* target);
  void read_leaf(const BooleanType& type, const Node& node, void* target);
  void read_leaf(const TextType& type, const Node& node, void* target);
  /// What is wrong with what an operator says, for people; empty: nothing.
  std::string order_error(const TextType& type, const std::string& text) const;
  void read_leaf(const WordType& type, const Node& node, void* target);
  void read_leaf(const PointType& type, const Node& node, void* target);
  void read_leaf(const FileType& type, const Node& node, void* target);
  // Of places, see places.h.
  bool has_only(const Node& map, std::span<const std::string_view> keys);
  std::optional<Vec2> geographic_place(const Node& node);
  std::optional<std::vector<Vec2>> feature_points(const Node& node, FeatureUse use);
  std::optional<Vec2> place(const Node& node);
  void read_feature_list(const ListType& type, const Node& node, void* target);
  void read_list(const ListType& type, const Node& node, void* target);
  void patch_list(const ListType& type, const Node& node, void* target);
  void read_optional(const OptionalType& type, const Node& node, void* target);
  void read_object(const Object& object, const Node& node, void* target,
                   const ChoiceType* choice, const std::string* kind);
  void read_choice(const ChoiceType& type, const Node& node, void* target);
  void apply_rules(const Object& object, const Node& node, const void* target);

  // A finite number that `range` allows; nothing, and a problem, otherwise.
  std::optional<double> number(const Node& node, const Range& range);
  const Kind* kind_named(const ChoiceType& type, const Node& name);

  // Problems at `place` with the current key path.
  void error(const Place& place, std::string message, std::string hint = {});
  void wrong_type(const Node& node, std::string hint = {});
  void out_of_range(const Node& node, const std::string& range);
  // A name that is called otherwise now: refused, unless the file is only described.
  void renamed(const Place& place, const std::string& from, const std::string& to);
  void unknown_key(const Object& object, const Node::Key& key, const Node& value,
                   const ChoiceType* choice, const std::string* kind);
  std::string default_hint() const;
  std::string path_text() const;
  bool faulty(const std::string& path) const;
  std::string last_key() const;

  const KindTable& kinds_;
  Folders folders_;
  const Places* places_;
  Problems& problems_;
  Care care_;
  std::vector<Step> path_;
  std::vector<std::string> faulty_;  // paths with problems
  // The value being read, for messages.
  const Type* type_ = nullptr;
  const void* default_ = nullptr;  // null where there is no default
  bool has_default_ = false;
  bool in_place_ = false;  // an override changes an element that exists
};

}  // namespace skein::scenario
