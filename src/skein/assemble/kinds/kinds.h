// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "skein/base/check.h"
#include "skein/base/result.h"
#include "skein/scenario/choice.h"
#include "skein/scenario/kind_table.h"

namespace skein::assemble {

/// The implementations of one role: rows of name, help, keys of the options, and how to
/// make one. `Context` is what every implementation of the role is given besides its
/// options.
template <class Product, class Context>
class Kinds {
 public:
  using Made = Result<std::unique_ptr<Product>>;

  explicit Kinds(std::string role) : role_(std::move(role)) {}

  /// Adds a row. `maker(options, context)` returns a unique_ptr or a Result of one.
  template <class Options, class Make>
  Kinds& add(std::string name, std::string help, const scenario::Fields<Options>& fields,
             Make maker) {
    descriptions_.push_back(
        [role = role_, name, help, fields](scenario::KindTable& table) {
          table.add(role, name, help, fields);
        });
    rows_.push_back({std::move(name),
                     [maker = std::move(maker)](const scenario::Choice& choice,
                                                const Context& context) -> Made {
                       return to_made(maker(choice.as<Options>(), context));
                     }});
    return *this;
  }

  /// Makes what the scenario chose. The reader has checked that the kind exists.
  Made make(const scenario::Choice& choice, const Context& context) const {
    for (const Row& row : rows_)
      if (row.name == choice.kind) return row.make(choice, context);
    SKEIN_CHECK(false, role_, choice.kind);
    return Error{};
  }

  /// Adds all rows of `more`, which has none of these names.
  void append(const Kinds& more) {
    descriptions_.insert(descriptions_.end(), more.descriptions_.begin(),
                         more.descriptions_.end());
    rows_.insert(rows_.end(), more.rows_.begin(), more.rows_.end());
  }

  /// Adds these kinds to the table that scenarios are read with.
  void describe(scenario::KindTable& table) const {
    for (const auto& description : descriptions_) description(table);
  }

 private:
  template <class Returned>
  static Made to_made(Returned returned) {
    if constexpr (std::is_same_v<Returned, Made>)
      return returned;
    else
      return std::unique_ptr<Product>(std::move(returned));
  }

  struct Row {
    std::string name;
    std::function<Made(const scenario::Choice&, const Context&)> make;
  };
  std::string role_;
  std::vector<std::function<void(scenario::KindTable&)>> descriptions_;
  std::vector<Row> rows_;
};

}  // namespace skein::assemble
