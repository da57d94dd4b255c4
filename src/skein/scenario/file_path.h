// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/problem.h"
#include "skein/scenario/source.h"
#include "skein/scenario/type.h"

namespace skein::scenario {

/// Where relative paths start, for each source that Place::source numbers.
struct Folders {
  /// Of the file itself, then of the overrides. Empty: the working folder.
  std::vector<std::filesystem::path> by_source;
  Source source;  ///< of the file

  const std::filesystem::path& of(const Place& place) const;
};

/// A path that a file names, and what is wrong with it.
struct NamedPath {
  std::string path;     ///< absolute, without `.` and `..`
  std::string problem;  ///< with the path in it, a sentence; empty: there is none
  std::string hint;     ///< how to change the file; may be empty
};

/// The one way from a path that is written in a file, or in an override, to a file of
/// this machine.
///
/// @param folder  where it starts when it is relative; empty: the working folder.
/// Of a path that leads nowhere from `folder`, but somewhere from the working folder, the
/// problem names both and the hint says what to write.
NamedPath find_file(std::string_view text, const std::filesystem::path& folder,
                    const FileType& type);

/// The same for the first word of a command, which is a file only when it has a slash and
/// does not begin with a place in braces. One that is nowhere is no problem: it may be
/// on another machine.
NamedPath find_program(std::string_view text, const std::filesystem::path& folder);

/// `text`, a command as an operator gives it, with the path of the file that it may name
/// made absolute, as NamedPath::path.
NamedPath find_file_of_order(std::string_view text, const std::filesystem::path& folder);

/// Whether a value of FileType::or_name is a file: its name ends in .yaml or .yml.
bool names_yaml_file(std::string_view text);

}  // namespace skein::scenario
