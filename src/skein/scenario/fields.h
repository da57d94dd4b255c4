// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "skein/base/time.h"
#include "skein/geo/polygon.h"
#include "skein/scenario/choice.h"
#include "skein/scenario/type.h"

namespace skein::scenario {

template <class T>
class Fields;

namespace detail {

template <class M>
struct Wrapped {
  using Leaf = M;
};
template <class M>
struct Wrapped<std::optional<M>> : Wrapped<M> {};
template <class M>
struct Wrapped<std::vector<M>> : Wrapped<M> {};

/// M without the lists and optionals around it.
template <class M>
using LeafOf = typename Wrapped<M>::Leaf;

/// A value with its defaults; Eigen's own default is whatever stood in memory.
template <class M>
M fresh() {
  if constexpr (std::same_as<M, Vec2>) {
    return Vec2::Zero();
  } else {
    return M{};
  }
}

/// Puts the lists and optionals of M around the description of its Leaf.
template <class M, class Leaf>
TypePtr wrap(const TypePtr& leaf) {
  if constexpr (std::same_as<M, Leaf>) {
    return leaf;
  } else {
    using Inner = typename M::value_type;
    const TypePtr inner = wrap<Inner, Leaf>(leaf);
    if constexpr (std::same_as<M, std::optional<Inner>>) {
      OptionalType type;
      type.inner = inner;
      type.has = [](const void* m) { return static_cast<const M*>(m)->has_value(); };
      type.reset = [](void* m) { static_cast<M*>(m)->reset(); };
      type.emplace = [](void* m) -> void* {
        return &static_cast<M*>(m)->emplace(fresh<Inner>());
      };
      type.get = [](void* m) -> void* { return &**static_cast<M*>(m); };
      return std::make_shared<Type>(Type{type});
    } else {
      static_assert(std::same_as<M, std::vector<Inner>>);
      ListType type;
      type.element = inner;
      type.size = [](const void* m) { return static_cast<const M*>(m)->size(); };
      type.clear = [](void* m) { static_cast<M*>(m)->clear(); };
      type.append = [](void* m) -> void* {
        return &static_cast<M*>(m)->emplace_back(fresh<Inner>());
      };
      type.at = [](void* m, std::size_t i) -> void* { return &(*static_cast<M*>(m))[i]; };
      return std::make_shared<Type>(Type{type});
    }
  }
}

/// The part of Fields that does not depend on the struct.
class FieldsBase {
 public:
  /// The finished description.
  ObjectPtr description() const { return std::make_shared<Object>(object_); }

 protected:
  void add(Field field);
  void set_required();
  void set_former(std::string key);
  void set_count(const Count& count);
  void add_rule(Rule rule) { object_.rules.push_back(std::move(rule)); }

  Object object_;
};

}  // namespace detail

/// A word of the file and the enumerator that it stands for.
template <class Enum>
struct Word {
  std::string name;
  Enum value;
  std::string help;
  std::string former = {};  ///< as it was called before; empty: as now
};

/// Describes how the members of the plain struct T are written in a file.
///
///   Fields<PlaneOptions>()
///       .number("airspeed_mps", &PlaneOptions::airspeed, "Cruise airspeed.",
///               {.above = 0, .at_most = 100})
///       .angle_deg("bank_deg", &PlaneOptions::bank, "Largest bank.", {.above = 0,
///                  .below = 80})
///
/// Each call adds one key. `member` is a pointer to a member, or anything that makes a
/// reference into the struct from `T&`. The member may also be a std::optional (`null`
/// stands for "none") or a std::vector (a list) of what is described, or both. Defaults
/// are those of a default-constructed T. Keys end in their unit (units.h); text meant for
/// the user says nothing of units or ranges: both are added to it.
/// Fails: Bug when a key is described twice.
template <class T>
class Fields : public detail::FieldsBase {
 public:
  Fields() {
    object_.prototype.template emplace<T>();
    object_.content = [](std::any& any) -> void* { return std::any_cast<T>(&any); };
  }

  /// A finite number; a double.
  template <class Member>
  Fields& number(std::string key, Member member, std::string help,
                 const Range& range = {}) {
    return add_leaf<double>(key, member, help,
                            NumberType{range, NumberType::Stored::kDouble});
  }

  /// An angle, in degrees in the file, in radians in the struct; a double. `range` is in
  /// degrees.
  template <class Member>
  Fields& angle_deg(std::string key, Member member, std::string help,
                    const Range& range = {.at_least = -360, .at_most = 360}) {
    return add_leaf<double>(key, member, help,
                            NumberType{range, NumberType::Stored::kRadians});
  }

  /// A span or moment in seconds; a Time or a double. At most 46 days, so that every
  /// number of nanoseconds has a decimal form of its own.
  template <class Member>
  Fields& duration_s(std::string key, Member member, std::string help,
                     Range range = {.at_least = 0}) {
    constexpr double kLongest = 4e6;
    if (range.below > kLongest && range.at_most > kLongest) range.at_most = kLongest;
    using Leaf = detail::LeafOf<MemberType<Member>>;
    constexpr auto kStored = std::same_as<Leaf, Time> ? NumberType::Stored::kTime
                                                      : NumberType::Stored::kDouble;
    static_assert(std::same_as<Leaf, Time> || std::same_as<Leaf, double>);
    return add_leaf<Leaf>(key, member, help, NumberType{range, kStored});
  }

  /// A whole number; any integer type. `range` is narrowed to what the type can hold.
  template <class Member>
  Fields& integer(std::string key, Member member, std::string help,
                  IntegerRange range = {}) {
    using Leaf = detail::LeafOf<MemberType<Member>>;
    static_assert(std::integral<Leaf> && !std::same_as<Leaf, bool>);
    using Limits = std::numeric_limits<Leaf>;
    if (std::cmp_less(range.at_least, Limits::min())) range.at_least = Limits::min();
    if (std::cmp_greater(range.at_most, Limits::max())) {
      range.at_most = static_cast<std::int64_t>(Limits::max());
    }
    return add_leaf<Leaf>(
        key, member, help,
        IntegerType{range, &get_as_integer<Leaf>, &set_as_integer<Leaf>});
  }

  /// `true` or `false`; a bool.
  template <class Member>
  Fields& boolean(std::string key, Member member, std::string help) {
    return add_leaf<bool>(key, member, help, BooleanType{});
  }

  /// Words; a std::string. With `allowed`, one of these.
  template <class Member>
  Fields& text(std::string key, Member member, std::string help,
               std::vector<std::string> allowed = {}) {
    return add_leaf<std::string>(key, member, help, TextType{std::move(allowed)});
  }

  /// A moment as `2026-07-01T12:00:00Z`; a std::string. See parse_utc.
  template <class Member>
  Fields& utc(std::string key, Member member, std::string help) {
    return add_leaf<std::string>(key, member, help, TextType{.utc = true});
  }

  /// A command that is run, the program and its arguments; a list of std::string. All
  /// such keys of a scenario need consent (named_commands()). A program that is a
  /// relative path starts as file() does.
  template <class Member>
  Fields& program(std::string key, Member member, std::string help) {
    return add_leaf<std::string>(key, member, help, TextType{.program = true});
  }

  /// A command as an operator gives it (data/command/command_text.h); a std::string. A
  /// file that it names starts as with file(), and its path is absolute after reading.
  template <class Member>
  Fields& order(std::string key, Member member, std::string help) {
    return add_leaf<std::string>(key, member, help,
                                 TextType{.says = TextType::Says::kCommand});
  }

  /// A task as an operator gives it (data/team/task_text.h), of any kind that there is;
  /// empty: none. A std::string.
  template <class Member>
  Fields& task(std::string key, Member member, std::string help) {
    return add_leaf<std::string>(key, member, help,
                                 TextType{.says = TextType::Says::kTask});
  }

  /// One of some words; an enumeration.
  template <class Member>
  Fields& word(
      std::string key, Member member, std::string help,
      std::initializer_list<
          Word<detail::LeafOf<std::remove_cvref_t<std::invoke_result_t<Member, T&>>>>>
          words) {
    using Enum = detail::LeafOf<MemberType<Member>>;
    static_assert(std::is_enum_v<Enum>);
    WordType type{{}, &get_as_integer<Enum>, &set_as_integer<Enum>};
    for (const Word<Enum>& w : words) {
      type.words.push_back(
          {w.name, w.help, static_cast<std::int64_t>(w.value), w.former});
    }
    return add_leaf<Enum>(key, member, help, std::move(type));
  }

  /// A place [m], `[north, east]` or as people have it (places.h); a Vec2.
  template <class Member>
  Fields& point(std::string key, Member member, std::string help,
                const Range& range = {.at_least = -1e7, .at_most = 1e7}) {
    return add_leaf<Vec2>(key, member, help, PointType{range, true});
  }

  /// `[north, east]`; a Vec2 that is no place: a velocity, an offset.
  template <class Member>
  Fields& vector(std::string key, Member member, std::string help,
                 const Range& range = {.at_least = -1e7, .at_most = 1e7}) {
    return add_leaf<Vec2>(key, member, help, PointType{range, false});
  }

  /// The corners of an area; a geo::Ring of at least three points.
  template <class Member>
  Fields& polygon(std::string key, Member member, std::string help) {
    const TypePtr corner =
        std::make_shared<Type>(Type{PointType{{.at_least = -1e7, .at_most = 1e7}, true}});
    Type ring = *detail::wrap<geo::Ring, Vec2>(corner);
    std::get<ListType>(ring.what).count.at_least = 3;
    return add_leaf<geo::Ring>(key, member, help, std::move(ring.what));
  }

  /// A file (or folder) that exists; a std::string, absolute after reading. In a file it
  /// is relative to that file, in an override to the override's folder.
  template <class Member>
  Fields& file(std::string key, Member member, std::string help,
               const FileType& type = {}) {
    return add_leaf<std::string>(key, member, help, type);
  }

  /// Keys below this key; a struct S.
  template <class Member, class S>
  Fields& object(std::string key, Member member, const Fields<S>& fields,
                 std::string help) {
    return add_leaf<S>(key, member, help, ObjectType{fields.description()});
  }

  /// The choice of an implementation of `role`; a Choice.
  template <class Member>
  Fields& kind(std::string key, Member member, std::string role, std::string help) {
    return add_leaf<Choice>(key, member, help, ChoiceType{std::move(role)});
  }

  /// The key added last must be given.
  Fields& required() {
    set_required();
    return *this;
  }

  /// The key added last was called `key` before: a file that says so is refused with the
  /// new name, and rewritten by `skein check --update`. What a run has recorded is read.
  Fields& formerly(std::string key) {
    set_former(std::move(key));
    return *this;
  }

  /// The key added last, a list, has this many elements. Without it a list of structs or
  /// choices has at most 10,000, any other as many as a file can hold.
  Fields& items(const Count& count) {
    set_count(count);
    return *this;
  }

  /// A condition on the whole struct, asked when all its keys are valid: `fault` returns
  /// what is wrong, as text for the user, or nothing. `key` is where it is reported.
  Fields& rule(std::string key, std::function<std::string(const T&)> error) {
    return rules([key = std::move(key), error = std::move(error)](const T& object) {
      std::vector<RuleViolation> found;
      if (std::string text = error(object); !text.empty())
        found.push_back({key, std::move(text)});
      return found;
    });
  }

  /// Conditions that may be broken in several places, asked when all keys are valid.
  Fields& rules(std::function<std::vector<RuleViolation>(const T&)> errors) {
    return rules_of_valid(
        [errors = std::move(errors)](const T& object, const ValidValues& valid) {
          return valid("") ? errors(object) : std::vector<RuleViolation>();
        });
  }

  /// Conditions between some of the keys, asked whenever the struct has been read:
  /// `faults` uses only values that it has asked `sound` about.
  Fields& rules_of_valid(
      std::function<std::vector<RuleViolation>(const T&, const ValidValues& valid)>
          errors) {
    add_rule([errors = std::move(errors)](const void* object, const ValidValues& valid) {
      return errors(*static_cast<const T*>(object), valid);
    });
    return *this;
  }

 private:
  template <class Member>
  using MemberType = std::remove_cvref_t<std::invoke_result_t<Member, T&>>;

  template <class I>
  static std::int64_t get_as_integer(const void* member) {
    return static_cast<std::int64_t>(*static_cast<const I*>(member));
  }
  template <class I>
  static void set_as_integer(void* member, std::int64_t value) {
    *static_cast<I*>(member) = static_cast<I>(value);
  }

  template <class Leaf, class Member>
  Fields& add_leaf(std::string& key, Member member, std::string& help,
                   decltype(Type::what) leaf) {
    const TypePtr type = std::make_shared<Type>(Type{std::move(leaf)});
    add({std::move(key), std::move(help), detail::wrap<MemberType<Member>, Leaf>(type),
         [member](void* object) -> void* {
           return &std::invoke(member, *static_cast<T*>(object));
         }});
    return *this;
  }
};

}  // namespace skein::scenario
