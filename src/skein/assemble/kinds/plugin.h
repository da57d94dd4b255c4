// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "skein/assemble/kinds/interface_version.h"
#include "skein/assemble/kinds/kind_registry.h"

// What a plugin includes: a shared library with kinds of one's own, see
// docs/extending.md.

namespace skein::assemble {

/// What a plugin and the program that loads it must have in common, because C++ objects
/// go to and fro. Plain numbers and text: it is read before anything else is trusted.
struct PluginInterface {
  std::uint64_t size = sizeof(PluginInterface);
  const char* version = kInterfaceVersion;  ///< of Skein
  const char* headers = kInterfaceHeaders;  ///< hash of Skein's headers
  std::int32_t standard_library = _GLIBCXX_RELEASE;
  std::int32_t string_layout = _GLIBCXX_USE_CXX11_ABI;
  std::int32_t eigen =
      10000 * EIGEN_WORLD_VERSION + 100 * EIGEN_MAJOR_VERSION + EIGEN_MINOR_VERSION;
  std::int32_t alignment = EIGEN_MAX_ALIGN_BYTES;  ///< of vectors: grows with -mavx
};

/// A plugin's own description, under the name `skein_plugin`:
///
///   const skein::assemble::Plugin skein_plugin{{}, add_my_kinds};
struct Plugin {
  PluginInterface interface;
  /// Adds the plugin's kinds to empty tables. Called once, when the plugin is loaded.
  void (*add_kinds)(KindsByRole& kinds);
};

}  // namespace skein::assemble

// NOLINTNEXTLINE(readability-identifier-naming): a C name, which dlsym looks up.
extern "C" [[gnu::visibility("default")]] const skein::assemble::Plugin skein_plugin;
