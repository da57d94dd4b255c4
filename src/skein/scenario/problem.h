// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <vector>

namespace skein::scenario {

/// Where a value was written. Source 0 is the scenario file, source k the k-th override.
struct Place {
  std::int32_t source = 0;
  std::int32_t line = 0;    ///< from 1; 0 = the whole source
  std::int32_t column = 0;  ///< from 1
  friend auto operator<=>(const Place&, const Place&) = default;
};

/// One validation error of a scenario, in words for the user.
struct Problem {
  Place place;
  std::string source;   ///< name of the file, or the override as `--set a.b=c`
  std::string key;      ///< full key, as `aircraft[1].plant.airspeed_mps`; may be empty
  std::string message;  ///< what was found and what is allowed
  std::string hint;     ///< what would mend it; may be empty

  /// `patrol.yaml:14:5 aircraft[1].plant.mass_kg: -1.2 must be above 0. Hint.`
  std::string text() const;
};

/// A name in a file that is called otherwise now.
struct Rename {
  Place place;
  std::string from, to;
};

/// All problems of one reading. Keeps the first kMax and counts the rest, so that ten
/// megabytes of nonsense do not become gigabytes of messages.
class Problems {
 public:
  static constexpr std::size_t kMax = 1000;

  /// @param sources  names of the sources, as Place::source numbers them.
  explicit Problems(std::vector<std::string> sources) : sources_(std::move(sources)) {}

  void add(const Place& place, std::string key, std::string message,
           std::string hint = {});
  std::size_t count() const { return count_; }
  /// Notes that a name of the file itself has changed; no problem by itself.
  void note(Rename rename);
  /// Those noted, in the order of their places. Empties this.
  std::vector<Rename> take_renames();
  /// No more details are worth computing.
  bool full() const { return list_.size() >= kMax; }
  /// Those kept, in the order of their places. Empties this.
  std::vector<Problem> take();

 private:
  std::vector<std::string> sources_;
  std::vector<Problem> list_;
  std::vector<Rename> renames_;
  std::size_t count_ = 0;
};

}  // namespace skein::scenario
