// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"

namespace skein {

/// What becomes of what is written to a path.
enum class OutputPlace {
  kReplaced,  ///< a regular file, or nothing yet: it appears whole or not at all
  kThrough,   ///< a device, a pipe, an open descriptor: it is written to and stays
};

/// How write_file() writes there; links are followed.
/// Fails: kUnavailable for a folder, a socket, and links in a circle.
Result<OutputPlace> output_place(const std::filesystem::path& file);

/// Writes a whole file; every file that is made in one go is written by this.
///
/// A regular file is written under another name beside it first and then renamed, so that
/// others see the old content or the new one; what was there keeps its permissions, and
/// its owner where that is allowed. Whatever else there is stays and is written to:
/// devices, pipes, terminals, `/dev/stdout`, `/proc/self/fd/N` (behind what the
/// descriptor has received already). What a symbolic link names is written, the link
/// stays.
/// Fails: kUnavailable when it cannot be written; then a regular file has its old
///        content.
Result<void> write_file(const std::filesystem::path& file, std::string_view text);
Result<void> write_file(const std::filesystem::path& file,
                        std::span<const std::byte> bytes);

/// Puts a finished file where write_file() would have written its content, and removes it
/// from where it is. Fails: as write_file(); kNotFound when it cannot be read.
Result<void> move_into_place(const std::filesystem::path& finished,
                             const std::filesystem::path& file);

/// Whether write_file() can write there, before the work whose result it is. Opens no
/// device or pipe. Fails: kUnavailable; as write_file().
Result<void> check_writable(const std::filesystem::path& file);

/// A file that is written piece by piece, for as long as there is something to write.
///
/// Another than a regular file, and an open descriptor, is written to as it is, as by
/// write_file(); a regular one begins empty, and others see what has been flushed.
class OutputStream {
 public:
  /// Fails: kUnavailable when it cannot be written.
  static Result<OutputStream> open(const std::filesystem::path& file);

  OutputStream() = default;  ///< nothing is written anywhere
  OutputStream(OutputStream&& other) noexcept;
  OutputStream& operator=(OutputStream&& other) noexcept;
  ~OutputStream();  ///< what was not flushed is lost

  bool is_open() const { return fd_ >= 0; }
  /// Appends; a failure is kept for flush().
  void write(std::string_view text);
  /// Hands all that was written to the system.
  /// Fails: kUnavailable when something could not be written.
  Result<void> flush();

 private:
  std::filesystem::path file_;
  int fd_ = -1;
  int failed_ = 0;  // errno
  std::string held_;
};

}  // namespace skein
