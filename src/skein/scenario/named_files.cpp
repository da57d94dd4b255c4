#include "skein/scenario/named_files.h"

#include <set>

namespace skein::scenario {
namespace {

// Walks through a value by its type, as writing does, and keeps only paths.
struct Collect {
  const void* value;
  const KindTable& kinds;
  std::set<std::string>& found;

  void walk(const Type& type, const void* at) const {
    std::visit(Collect{at, kinds, found}, type.what);
  }
  void walk(const Object& object, const void* members) const {
    for (const Field& field : object.fields) walk(*field.type, field.in(members));
  }
  void* writable() const { return const_cast<void*>(value); }  // only ever read

  template <class Leaf>
  void operator()(const Leaf&) const {}
  void operator()(const FileType&) const {
    const auto& path = *static_cast<const std::string*>(value);
    if (!path.empty()) found.insert(path);
  }
  void operator()(const ListType& type) const {
    for (std::size_t i = 0; i < type.size(value); ++i)
      walk(*type.element, type.at(writable(), i));
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
};

}  // namespace

std::vector<std::string> named_files(const Scenario& scenario, const KindTable& kinds) {
  std::set<std::string> found;
  Collect{&scenario, kinds, found}.walk(*scenario_fields().description(), &scenario);
  return {found.begin(), found.end()};
}

}  // namespace skein::scenario
