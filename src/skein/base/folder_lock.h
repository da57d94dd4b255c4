// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "skein/base/result.h"

namespace skein {

/// The right to write into a folder, which one process has at a time, and of its parts
/// one: a lock on the file `.skein-lock` in it. The system takes the lock back when the
/// process ends, however it ends; the file stays and means nothing by itself.
class FolderLock {
 public:
  static constexpr const char* kFileName = ".skein-lock";

  /// Takes the folder, which is there already.
  /// @param what  what shall be done there, for those who are refused: "a run".
  /// Fails: kBadInput when somebody else has it, with what and the number of its
  ///        process; kUnavailable when no lock can be made there.
  static Result<FolderLock> take(const std::filesystem::path& folder,
                                 const std::string& what);

  /// What goes on in a folder and by which process, as text; none: nothing.
  static std::optional<std::string> holder(const std::filesystem::path& folder);

  FolderLock() = default;  ///< of no folder
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  explicit FolderLock(int fd) : fd_(fd) {}
  int fd_ = -1;
};

}  // namespace skein
