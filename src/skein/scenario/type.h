// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// What a key's value may be and how it is stored, without templates: the one description
// that reading, checking, writing, the JSON Schema and the documentation are made from.
// It is built with Fields (fields.h). Values are reached through `void*`: each type below
// says which C++ type stands there.

namespace skein::scenario {

/// The numbers that a key allows, in the file's unit. Give `above` or `at_least`, and
/// `below` or `at_most`.
struct Range {
  double above = -std::numeric_limits<double>::infinity();
  double at_least = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();

  bool holds(double value) const;
  /// "above 0 and at most 100"; empty when every number is allowed.
  std::string text() const;
};

struct IntegerRange {
  std::int64_t at_least = std::numeric_limits<std::int64_t>::min();
  std::int64_t at_most = std::numeric_limits<std::int64_t>::max();

  std::string text() const;
};

/// How many elements a list may have.
struct Count {
  std::size_t at_least = 0;
  std::size_t at_most = std::numeric_limits<std::size_t>::max();
};

struct Type;
using TypePtr = std::shared_ptr<const Type>;

/// A finite number.
struct NumberType {
  enum class Stored {
    kDouble,   ///< a double, as in the file
    kRadians,  ///< a double [rad]; degrees in the file
    kTime,     ///< a skein::Time; seconds in the file
  };
  Range range;
  Stored stored = Stored::kDouble;
};

/// A whole number, stored in any integer type.
struct IntegerType {
  IntegerRange range;
  std::int64_t (*get)(const void*) = nullptr;
  void (*set)(void*, std::int64_t) = nullptr;
};

/// `true` or `false`; a bool.
struct BooleanType {};

/// A std::string.
struct TextType {
  std::vector<std::string> allowed = {};  ///< empty: any
  bool utc = false;                       ///< a moment, see utc.h
  /// A word of a command that is run: it needs consent, and its first word may be a file.
  bool program = false;
  /// What an operator says: a whole command, of which the file that it may name is
  /// absolute, or a task alone.
  enum class Says { kAnything, kCommand, kTask } says = Says::kAnything;
};

/// One of some words, each standing for an enumerator.
struct WordType {
  struct Word {
    std::string name;
    std::string help;
    std::int64_t value = 0;
    std::string former = {};  ///< as it was called before; empty: as now
  };
  std::vector<Word> words;
  std::int64_t (*get)(const void*) = nullptr;
  void (*set)(void*, std::int64_t) = nullptr;
};

/// `[north, east]`; a Vec2. Each of the two lies in `range`. A place may be given in
/// other ways too (places.h).
struct PointType {
  Range range;
  bool place = false;
};

/// A std::string with the path of a file that exists, made absolute.
struct FileType {
  bool may_be_empty = false;  ///< "" = no file
  bool folder = false;        ///< a folder instead
  /// What does not end in .yaml or .yml is the name of something that is part of the
  /// program, whatever files there are.
  bool or_name = false;
};

/// Elements of one type; a std::vector.
struct ListType {
  TypePtr element;
  Count count;
  std::size_t (*size)(const void*) = nullptr;
  void (*clear)(void*) = nullptr;
  void* (*append)(void*) = nullptr;
  void* (*at)(void*, std::size_t) = nullptr;
};

/// A value or `null`; a std::optional.
struct OptionalType {
  TypePtr inner;
  bool (*has)(const void*) = nullptr;
  void (*reset)(void*) = nullptr;
  void* (*emplace)(void*) = nullptr;
  void* (*get)(void*) = nullptr;
};

struct Object;
using ObjectPtr = std::shared_ptr<const Object>;

/// Keys and values; a struct.
struct ObjectType {
  ObjectPtr object;
};

/// A choice of an implementation; a Choice (choice.h).
struct ChoiceType {
  std::string role;
};

struct Type {
  std::variant<NumberType, IntegerType, BooleanType, TextType, WordType, PointType,
               FileType, ListType, OptionalType, ObjectType, ChoiceType>
      what;
};

/// One key of a struct.
struct Field {
  std::string key;
  std::string help;
  TypePtr type;
  std::function<void*(void*)> member;  ///< where in the struct the value stands
  bool required = false;
  std::string former = {};  ///< as it was called before; empty: as now

  const void* in(const void* object) const { return member(const_cast<void*>(object)); }
  void* in(void* object) const { return member(object); }
};

/// What a condition between several keys of a struct finds wrong.
struct RuleViolation {
  /// Where it is reported: a path from the struct, as "aircraft[1].agent_period_s".
  std::string key;
  std::string message;
  /// The other values that it is about, as paths: it is shown at the first of them that
  /// the file gives where it does not give `key`.
  std::vector<std::string> with = {};
};

/// Which values of a struct were read without a problem. A value that could not be read
/// holds its default or whatever else stood there, so a rule asks before it uses one.
class ValidValues {
 public:
  using Ask = std::function<bool(const std::string& path)>;

  explicit ValidValues(Ask ask) : ask_(std::move(ask)) {}

  /// Whether there is no problem at any of these paths from the struct (as
  /// "aircraft[1].agent_period_s"; "" is the whole struct), around or below them.
  template <class... Paths>
  bool operator()(const Paths&... paths) const {
    return (ask_(paths) && ...);
  }

 private:
  Ask ask_;
};

/// A condition between several keys of a struct: the errors that it finds among values
/// that are valid by themselves.
using Rule = std::function<std::vector<RuleViolation>(const void*, const ValidValues&)>;

/// A struct and its keys.
struct Object {
  std::vector<Field> fields;
  std::vector<Rule> rules;
  std::any prototype;                     ///< the struct with its defaults
  void* (*content)(std::any&) = nullptr;  ///< where the struct stands in such an any

  const Field* find(std::string_view key) const;
  /// The field that was called so before; null: none was.
  const Field* find_former(std::string_view key) const;
  const void* defaults() const { return content(const_cast<std::any&>(prototype)); }
};

/// What a value of this type looks like, as "a number above 0" or "a list of files".
std::string expected(const Type& type);

}  // namespace skein::scenario
