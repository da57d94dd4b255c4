// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "skein/data/describe/type_traits.h"
#include "skein/data/describe/words.h"
#include "skein/data/team/task_form.h"
#include "skein/data/team/task_value.h"

// Tasks of one kind from words, by the description of its values. For task_form_of.h.

namespace skein::task_words {

using Words = TaskForm::Words;

template <class M>
inline constexpr bool kIsNumber =
    (std::is_arithmetic_v<M> && !std::is_same_v<M, bool>) || std::is_same_v<M, Time> ||
    std::is_same_v<M, std::optional<double>> ||
    std::is_same_v<M, std::optional<std::uint32_t>>;
template <class M>
inline constexpr bool kIsPoints = std::is_same_v<M, std::vector<Vec2>>;

template <class M, class Form>
bool set_number(M& value, double written, const Form& form) {
  if (!std::isfinite(written)) return false;
  if constexpr (std::is_same_v<M, Time>) {
    if (std::abs(written) > 1e9) return false;
    value = Time::from_seconds(written);
  } else if constexpr (type_traits::kIsOptional<M>) {
    typename M::value_type inner{};
    if (!set_number(inner, written, form)) return false;
    value = inner;
  } else if constexpr (std::integral<M>) {
    if (written != std::floor(written) || written < 0 || written > 1e9) return false;
    value = static_cast<M>(written);
  } else if constexpr (std::is_same_v<Form, Unit>) {
    value = written / form.factor;
  }
  return true;
}

// Fills a task of one kind from words.
template <class T>
class Filler {
 public:
  Result<TaskText> fill(Words words) {
    while (error_.empty() && !words.empty()) words = words.subspan(take(words));
    if (error_.empty() && needs_place() && places_ == 0) error_ = "it needs a place.";
    if (error_.empty() && needs_points() && places_ < 2 && !kMayBeOnePoint)
      error_ = "it needs points.";
    if (error_.empty() && entities() != text_.others.size())
      error_ = fmt::format("it needs {} name{} of aircraft.", entities(),
                           entities() == 1 ? "" : "s");
    if (!error_.empty())
      return Error{ErrorCode::kBadInput, "", fmt::format("{}: {}", kind_of<T>(), error_),
                   ""};
    if constexpr (std::is_same_v<T, LandAt>) task_.at_home = places_ == 0;
    if constexpr (std::is_same_v<T, Orbit>)
      if (places_ == 0 && !task_.object)
        return Error{ErrorCode::kBadInput, "", "orbit: it needs a place or an object.",
                     ""};
    text_.what = as_task(std::move(task_));
    return std::move(text_);
  }

 private:
  static constexpr bool kMayBeOnePoint = std::is_same_v<T, FlyRoute>;

  // An object may be seen on the way.
  static constexpr bool kMayHaveNoPlace =
      std::is_same_v<T, LandAt> || std::is_same_v<T, Orbit>;
  static bool needs_place() { return !kMayHaveNoPlace && has<Vec2>(); }
  static bool needs_points() { return has<std::vector<Vec2>>(); }

  template <class Wanted>
  static bool has() {
    bool found = false;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>&) {
      found = found || std::is_same_v<M, Wanted>;
    });
    return found;
  }

  static std::size_t entities() {
    std::size_t count = 0;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>&) {
      count += type_traits::kIsId<M> ? 1 : 0;
    });
    return count;
  }

  // How many words it has used.
  std::size_t take(Words words) {
    const std::string_view word = words.front();
    if (const auto place = words::place(word)) return take_place(*place);
    const std::string_view value = words.size() > 1 ? words[1] : std::string_view();
    if (word == "file" && std::is_same_v<T, FlyPlan> && !value.empty()) {
      text_.file = value;
      return 2;
    }
    if (const std::size_t used = take_named(word, value)) return used;
    if (!error_.empty()) return 1;
    if (const auto number = words::number(word)) return take_number(*number, word);
    if (text_.others.size() < entities()) {
      text_.others.emplace_back(word);
      return 1;
    }
    error_ = fmt::format("\"{}\" says nothing to it.", word);
    return 1;
  }

  // The next place of its own, or a further point.
  std::size_t take_place(const Vec2& place) {
    bool used = false;
    int k = 0;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      if (used) return;
      if constexpr (std::is_same_v<M, Vec2>) {
        if (k++ < places_) return;
        task_.*f.member = place;
        used = true;
      } else if constexpr (kIsPoints<M>) {
        (task_.*f.member).push_back(place);
        used = true;
      }
    });
    ++places_;
    if (!used || !place.allFinite())
      error_ = "it has a place too many, or one that is none.";
    return 1;
  }

  std::size_t take_named(std::string_view word, std::string_view value) {
    std::size_t used = 0;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      if (used > 0 || f.name.empty()) return;
      if constexpr (std::is_same_v<M, bool>) {
        const bool off = word.starts_with("counter") || word.starts_with("no-");
        const std::string_view name =
            off ? word.substr(word.starts_with("no-") ? 3 : 7) : word;
        if (name != f.name) return;
        task_.*f.member = !off;
        used = 1;
      } else if constexpr (kIsNumber<M>) {
        if (word != f.name) return;
        const auto number = words::number(value);
        if (number && set_number(task_.*f.member, *number, f.form))
          used = 2;
        else
          error_ = fmt::format("{} needs a number.", f.name);
      }
    });
    return used;
  }

  // The first number that it has.
  std::size_t take_number(double number, std::string_view word) {
    bool used = false;
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      if constexpr (kIsNumber<M>)
        if (!used && numbers_ == 0) used = set_number(task_.*f.member, number, f.form);
    });
    ++numbers_;
    if (!used) error_ = fmt::format("\"{}\" says nothing to it.", word);
    return 1;
  }

  T task_;
  TaskText text_;
  int places_ = 0, numbers_ = 0;
  std::string error_;
};

template <class T>
std::string usage_of() {
  std::string text(short_kind(kind_of<T>()));
  for_each_field<T>(
      [&]<class O, class M, class F>([[maybe_unused]] const Field<O, M, F>& f) {
        if constexpr (type_traits::kIsId<M>) text += " AIRCRAFT";
      });
  bool points = false;
  for_each_field<T>(
      [&]<class O, class M, class F>([[maybe_unused]] const Field<O, M, F>& f) {
        if constexpr (std::is_same_v<M, Vec2>) {
          if (f.name.empty()) {
            if constexpr (std::is_same_v<F, Axes>)
              text += f.form.names[0] == "forward" ? " FORWARD,RIGHT"
                      : std::is_same_v<T, LandAt>  ? " [NORTH,EAST]"
                                                   : " NORTH,EAST";
          }
        } else if constexpr (kIsPoints<M>) {
          if (!points) text += " NORTH,EAST ...";
          points = true;
        } else if constexpr (std::is_same_v<M, bool>) {
          // The word that changes what it is without one.
          const std::string_view off = f.name == "clockwise" ? "counter" : "no-";
          if (!std::is_same_v<T, LandAt>)
            text += fmt::format(" [{}{}]", T{}.*f.member ? off : "", f.name);
        } else if constexpr (kIsNumber<M>) {
          std::string unit;
          if constexpr (std::is_same_v<F, Unit>)
            unit = f.form.suffix.empty() ? "N" : std::string(f.form.suffix.substr(1));
          if constexpr (std::is_same_v<M, Time>) unit = "s";
          text += fmt::format(" [{} {}]", f.name, unit);
        }
      });
  if (std::is_same_v<T, FlyPlan>) text += " file NAME";
  return text;
}

}  // namespace skein::task_words
