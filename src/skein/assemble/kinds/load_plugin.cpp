// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/load_plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string_view>

#include "skein/assemble/kinds/plugin.h"

namespace skein::assemble {
namespace {

constexpr const char* kRebuild = "Build the plugin anew against this Skein.";

Error cannot_load(const std::string& file, std::string message, std::string hint = {}) {
  return {ErrorCode::kBadInput, file, std::move(message), std::move(hint)};
}

// What the dynamic linker says, without the path that every message begins with.
std::string linker_message(const std::string& file) {
  const char* said = dlerror();
  std::string text = said != nullptr ? said : "unknown reason";
  if (text.starts_with(file + ": ")) text.erase(0, file.size() + 2);
  return text;
}

Error cannot_load(const std::string& file) {
  const std::string why = linker_message(file);
  const bool symbol = why.find("undefined symbol") != std::string::npos;
  return cannot_load(
      file, fmt::format("cannot be loaded: {}.", why),
      symbol ? "Built against another Skein, or linked without a library that "
               "it needs?"
             : "A plugin is a shared library, see docs/extending.md.");
}

// How the interface that a plugin was built for differs from ours; empty: it does not.
std::string difference(const PluginInterface& theirs) {
  const PluginInterface ours;
  if (theirs.size != ours.size)
    return "it was built for a Skein whose interface has another layout.";
  const auto differ = [](std::string_view what, const auto& of_plugin, const auto& here) {
    return fmt::format("it was built for {} {}, this program has {}.", what, of_plugin,
                       here);
  };
  if (std::string_view(theirs.version) != ours.version)
    return differ("Skein", theirs.version, ours.version);
  if (std::string_view(theirs.headers) != ours.headers)
    return differ("headers of Skein with hash", theirs.headers, ours.headers);
  if (theirs.standard_library != ours.standard_library)
    return differ("libstdc++", theirs.standard_library, ours.standard_library);
  if (theirs.string_layout != ours.string_layout)
    return differ("_GLIBCXX_USE_CXX11_ABI", theirs.string_layout, ours.string_layout);
  if (theirs.eigen != ours.eigen) return differ("Eigen", theirs.eigen, ours.eigen);
  if (theirs.alignment != ours.alignment)
    return differ("vectors aligned to bytes (-march, -mavx...)", theirs.alignment,
                  ours.alignment);
  return {};
}

}  // namespace

namespace {

Result<std::string> canonical_path(const std::filesystem::path& file) {
  std::error_code error;
  std::string path = std::filesystem::canonical(file, error).string();
  if (!error) return path;
  return Error{ErrorCode::kNotFound, file.string(),
               fmt::format("cannot be read: {}.", error.message()), ""};
}

// Whether others than its owner's group may put something else in its place.
bool is_replaceable(const std::filesystem::path& path) {
  using std::filesystem::perms;
  std::error_code error;
  const perms file = std::filesystem::status(path, error).permissions();
  const perms folder = std::filesystem::status(path.parent_path(), error).permissions();
  const auto has = [](perms all, perms one) { return (all & one) != perms::none; };
  return has(file, perms::others_write) ||
         (has(folder, perms::others_write) && !has(folder, perms::sticky_bit));
}

Result<void> load_library(const std::string& path, KindRegistry& registry) {
  // Functions are bound only when the interface is known to be ours.
  void* library = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) return cannot_load(path);
  const auto* plugin = static_cast<const Plugin*>(dlsym(library, "skein_plugin"));
  if (plugin == nullptr)
    return cannot_load(path, "is no plugin of Skein: it has no symbol skein_plugin.",
                       "See docs/extending.md.");
  if (std::string found = difference(plugin->interface); !found.empty())
    return cannot_load(path, std::move(found), kRebuild);
  if (dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr) return cannot_load(path);
  if (plugin->add_kinds == nullptr)
    return cannot_load(path, "its skein_plugin has no function that adds kinds.");

  KindsByRole kinds;
  try {
    plugin->add_kinds(kinds);
  } catch (const std::exception& thrown) {
    return cannot_load(path, fmt::format("cannot add its kinds: {}", thrown.what()));
  }
  return registry.add(kinds, path);
}

}  // namespace

Result<void> load_plugin(const std::filesystem::path& file, KindRegistry& registry) {
  const auto path = canonical_path(file);
  if (!path) return path.error();
  if (registry.has_plugin(path.value())) return {};
  return load_library(path.value(), registry);
}

Result<void> load_named_plugin(const std::filesystem::path& file,
                               const scenario::Source& named_in, KindRegistry& registry) {
  // The path that is asked about is the one that is loaded.
  const auto path = canonical_path(file);
  if (!path) return path.error();
  if (registry.has_plugin(path.value())) return {};
  if (!registry.consent())
    return Error{ErrorCode::kUnavailable, path.value(),
                 "is not loaded: nobody consents to libraries that scenarios name.",
                 "Give the table of kinds a CodeConsent."};
  if (auto allowed = registry.consent()->library(path.value(), named_in); !allowed)
    return allowed;
  if (is_replaceable(path.value()))
    return cannot_load(path.value(),
                       "is not loaded: everybody may write it, or its folder.",
                       "Take that permission away (chmod o-w).");
  return load_library(path.value(), registry);
}

}  // namespace skein::assemble
