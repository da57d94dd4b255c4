// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::campaign {

/// What changes when outside data changes: a hash of the contents of files, of all files
/// of folders, of files of the same stem beside a file (the parts of a shapefile) and of
/// files beside a CSV file that it names. Each path is read once.
class DataFingerprint {
 public:
  /// @param paths  of files and folders.
  /// @returns      32 hexadecimal digits; empty without any path.
  /// Fails: kUnavailable, with the name, for one that is not there, is no regular file or
  ///        cannot be read; also for one beside it that belongs to it.
  Result<std::string> of(const std::vector<std::string>& paths);

 private:
  std::map<std::string, std::string> known_;  // by path
};

}  // namespace skein::campaign
