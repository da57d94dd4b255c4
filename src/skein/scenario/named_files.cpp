// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/named_files.h"

#include <set>

#include "skein/scenario/file_path.h"

namespace skein::scenario {
namespace {

// Walks through a value by its type, as writing does, and keeps paths and commands.
struct Collect {
  const void* value;
  const KindTable& kinds;
  std::set<std::string>& files;
  std::vector<std::vector<std::string>>& commands;

  void walk(const Type& type, const void* at) const {
    std::visit(Collect{at, kinds, files, commands}, type.what);
  }
  void walk(const Object& object, const void* members) const {
    for (const Field& field : object.fields) walk(*field.type, field.in(members));
  }
  void* writable() const { return const_cast<void*>(value); }  // only ever read

  template <class Leaf>
  void operator()(const Leaf&) const {}
  void operator()(const TextType& type) const {
    const auto& word = *static_cast<const std::string*>(value);
    if (type.program && !word.empty()) commands.push_back({word});
  }
  void operator()(const FileType& type) const {
    const auto& path = *static_cast<const std::string*>(value);
    const bool is_name = type.or_name && !names_yaml_file(path);
    if (!path.empty() && !is_name) files.insert(path);
  }
  void operator()(const ListType& type) const {
    const std::size_t before = commands.size();
    for (std::size_t i = 0; i < type.size(value); ++i)
      walk(*type.element, type.at(writable(), i));
    const auto* text = std::get_if<TextType>(&type.element->what);
    if (text && text->program) join_words(before);
  }
  void operator()(const OptionalType& type) const {
    if (type.has(value)) walk(*type.inner, type.get(writable()));
  }
  void operator()(const ObjectType& type) const { walk(*type.object, value); }
  void operator()(const ChoiceType& type) const {
    const auto& choice = *static_cast<const Choice*>(value);
    const Kind* kind = kinds.find(type.role, choice.kind);
    if (kind != nullptr && choice.options.has_value())
      walk(*kind->options, kind->options->content(const_cast<std::any&>(choice.options)));
  }

  // The words of one list are one command.
  void join_words(std::size_t first) const {
    std::vector<std::string> command;
    for (std::size_t k = first; k < commands.size(); ++k)
      command.push_back(std::move(commands[k].front()));
    commands.resize(first);
    if (!command.empty()) commands.push_back(std::move(command));
  }
};

struct Named {
  std::set<std::string> files;
  std::vector<std::vector<std::string>> commands;
};

Named named_by(const Scenario& scenario, const KindTable& kinds) {
  Named found;
  Collect{&scenario, kinds, found.files, found.commands}.walk(
      *scenario_fields().description(), &scenario);
  return found;
}

}  // namespace

std::vector<std::string> named_files(const Scenario& scenario, const KindTable& kinds) {
  const Named found = named_by(scenario, kinds);
  return {found.files.begin(), found.files.end()};
}

std::vector<std::vector<std::string>> named_commands(const Scenario& scenario,
                                                     const KindTable& kinds) {
  return named_by(scenario, kinds).commands;
}

}  // namespace skein::scenario
