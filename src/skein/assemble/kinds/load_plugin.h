// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/base/result.h"

namespace skein::assemble {

/// Loads a shared library (plugin.h) and adds its kinds to `registry`. It stays in memory
/// until the program ends, since what it made may live as long. One that the registry has
/// already is passed over.
///
/// Only programs that export Skein's symbols can load plugins: `skein` does.
///
/// Fails: kNotFound without such a file; kBadInput when it is no shared library, no
///        plugin, made for another interface, or as KindRegistry::add().
Result<void> load_plugin(const std::filesystem::path& file, KindRegistry& registry);

/// The same of one that a scenario names: KindRegistry::consent() is asked before, unless
/// the registry has it already.
/// Fails: as load_plugin() and CodeConsent::library(); kUnavailable when nobody can be
///        asked.
Result<void> load_named_plugin(const std::filesystem::path& file,
                               const scenario::Source& named_in, KindRegistry& registry);

}  // namespace skein::assemble
