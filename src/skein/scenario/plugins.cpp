// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/plugins.h"

#include <fmt/format.h>

#include "skein/scenario/fields.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/node.h"
#include "skein/scenario/read.h"

namespace skein::scenario {
namespace {

// The key `plugins` alone, as in the whole scenario.
struct PluginList {
  std::vector<std::string> plugins;
};

ObjectPtr plugin_key() {
  return Fields<PluginList>()
      .file("plugins", &PluginList::plugins, "Shared libraries.")
      .description();
}

}  // namespace

LoadPlugin plugins_are_loaded() {
  return [](const std::string&, const Source&) { return Result<void>(); };
}

bool load_plugins(const Node& root, const Folders& folders, const LoadPlugin& load,
                  Problems& problems) {
  const Node* named = root.find("plugins");
  if (named == nullptr) return true;
  const std::size_t before = problems.count();
  Node alone = Node::of(Node::Kind::kMap, root.place);
  alone.put("plugins", *named, named->place);
  PluginList list;
  const KindTable no_kinds;
  Reader(no_kinds, folders, nullptr, problems)
      .read(Type{ObjectType{plugin_key()}}, alone, &list);
  if (problems.count() > before) return false;
  for (std::size_t i = 0; i < list.plugins.size(); ++i) {
    const Result<void> loaded =
        load ? load(list.plugins[i], folders.source)
             : Error{ErrorCode::kUnavailable, list.plugins[i],
                     "cannot be used: this program loads no plugins.", ""};
    if (loaded) continue;
    const Place& place = i < named->items.size() ? named->items[i].place : named->place;
    problems.add(place, fmt::format("plugins[{}]", i), loaded.error().text());
  }
  return problems.count() == before;
}

}  // namespace skein::scenario
