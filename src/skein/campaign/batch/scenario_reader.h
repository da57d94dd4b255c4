// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/scenario/kind_table.h"
#include "skein/scenario/override.h"
#include "skein/scenario/plugins.h"
#include "skein/scenario/scenario_file.h"

namespace skein::campaign {

/// Reads the scenarios of the runs of a campaign or a study, with the libraries that they
/// name. By one thread at a time.
class ScenarioReader {
 public:
  /// For scenarios whose libraries are loaded: `kinds` has all that they name.
  ScenarioReader(const scenario::KindTable& kinds)  // NOLINT: such a table is a reader
      : kinds_(kinds), load_(scenario::plugins_are_loaded()) {}
  /// @param kinds    outlives this; `load` adds to it.
  /// @param load     asks for consent, and loads a library that a scenario names.
  /// @param plugins  libraries that are loaded, absolute: every run's scenario names them
  ///                 too, so that it can be run again.
  /// @param stop     asks for an early end; null: nobody does.
  ScenarioReader(const scenario::KindTable& kinds, scenario::LoadPlugin load,
                 std::vector<std::string> plugins,
                 const std::atomic<bool>* stop = nullptr)
      : kinds_(kinds),
        load_(std::move(load)),
        plugins_(std::move(plugins)),
        stop_(stop) {}

  const scenario::KindTable& kinds() const { return kinds_; }

  /// A file is read the first time only; so are the map files that it names.
  /// Fails: kBadInput with all that is wrong; kInterrupted as go_on().
  Result<scenario::Scenario> read(const std::filesystem::path& file,
                                  std::span<const scenario::Override> overrides) const;

  /// Fails: kInterrupted when an early end is asked for. Who plans many runs asks for
  /// each.
  Result<void> go_on() const;

 private:
  const scenario::KindTable& kinds_;
  scenario::LoadPlugin load_;
  std::vector<std::string> plugins_;
  const std::atomic<bool>* stop_ = nullptr;
  mutable std::map<std::filesystem::path, scenario::OpenedDocument> opened_;
};

}  // namespace skein::campaign
