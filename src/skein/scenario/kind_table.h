// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/data/team/task_form.h"
#include "skein/scenario/choice.h"
#include "skein/scenario/fields.h"
#include "skein/scenario/places.h"

namespace skein::scenario {

/// One implementation that a scenario can name.
struct Kind {
  std::string name;
  std::string help;
  ObjectPtr options;  ///< the keys of its options struct
};

/// Options of a kind that has none.
struct NoOptions {};

/// Stops with a Bug when a default of `object` is not what its own key allows.
/// @param name  of the struct, for the message.
void check_defaults(const std::string& name, const Object& object);

/// The implementations that scenarios can choose from, by role ("estimator", "radio"...).
/// Filled by whoever knows them; this module does not.
class KindTable {
 public:
  /// Adds a kind. A Choice of it holds an Options struct.
  /// Fails: Bug when the name is taken, or a default breaks its own range.
  template <class Options>
  KindTable& add(const std::string& role, std::string name, std::string help,
                 const Fields<Options>& fields) {
    add_kind(role, {std::move(name), std::move(help), fields.description()});
    return *this;
  }
  /// Adds a kind without options.
  KindTable& add(const std::string& role, std::string name, std::string help) {
    return add(role, std::move(name), std::move(help), Fields<NoOptions>());
  }

  /// What reads features of map files, for places (places.h). Empty: nothing does.
  const FeatureReader& feature_reader() const { return feature_reader_; }
  void set_feature_reader(FeatureReader reader) { feature_reader_ = std::move(reader); }

  /// What somebody may have meant who names a kind of a role that there is not; "":
  /// nobody knows.
  using NameHint = std::function<std::string(std::string_view role, std::string_view)>;
  std::string name_hint(std::string_view role, std::string_view name) const {
    return name_hint_ ? name_hint_(role, name) : "";
  }
  void set_name_hint(NameHint hint) { name_hint_ = std::move(hint); }

  /// The kinds of tasks that commands and missions may name: at first those that messages
  /// have types for.
  const TaskForms& task_forms() const {
    return task_forms_ ? *task_forms_ : message_task_forms();
  }
  void set_task_forms(std::shared_ptr<const TaskForms> forms) {
    task_forms_ = std::move(forms);
  }

  /// The kinds of a role, in the order of adding; none for an unknown role.
  const std::vector<Kind>& of(std::string_view role) const;
  /// Null when there is none.
  const Kind* find(std::string_view role, std::string_view name) const;
  std::vector<std::string> names(std::string_view role) const;
  std::vector<std::string> roles() const;

 private:
  void add_kind(const std::string& role, Kind kind);

  std::map<std::string, std::vector<Kind>, std::less<>> kinds_;
  FeatureReader feature_reader_;
  NameHint name_hint_;
  std::shared_ptr<const TaskForms> task_forms_;
};

/// A kind as a scenario has it that says nothing but its name. It must exist.
Choice default_choice(const KindTable& kinds, std::string_view role,
                      std::string_view name);

}  // namespace skein::scenario
