// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace skein::hmi {

/// Lines from a terminal or pipe, without waiting for them.
///
/// A line of more than kMaxBytes is dropped: "(too long)" stands in its place.
class LineInput {
 public:
  static constexpr std::size_t kMaxBytes = 65536;

  /// @param descriptor  open while this lives; negative: none, no lines.
  explicit LineInput(int descriptor) : descriptor_(descriptor) {}

  /// The lines that have come since the last call, in order; a last one without its end
  /// counts when the input has ended. Cost: a question to the system, while it is open.
  std::vector<std::string> take();

 private:
  int descriptor_;
  std::string begun_;
  bool too_long_ = false;
};

}  // namespace skein::hmi
