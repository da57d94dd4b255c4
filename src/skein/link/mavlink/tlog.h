// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "skein/base/output_file.h"
#include "skein/base/result.h"
#include "skein/link/mavlink/frame.h"

namespace skein::mavlink {

/// A frame without its signature, with the CRC that it then has: for a record, which has
/// no use for one. Of a kind that is not known here, as it is.
std::vector<std::byte> without_signature(const Frame& frame);

/// Writes frames as ground stations record them (.tlog): before each the time at which it
/// came, in microseconds since 1970, eight bytes, the highest first.
class TlogWriter {
 public:
  /// Begins a file; one that is there is replaced.
  /// Fails: kUnavailable where it cannot be written.
  static Result<TlogWriter> create(const std::filesystem::path& file);

  /// Appends a frame, without its signature.
  void write(std::int64_t unix_us, const Frame& frame);

  /// Hands all that was written to the system.
  /// Fails: kUnavailable when something could not be written.
  Result<void> flush();

 private:
  explicit TlogWriter(OutputStream out) : out_(std::move(out)) {}

  OutputStream out_;
};

}  // namespace skein::mavlink
