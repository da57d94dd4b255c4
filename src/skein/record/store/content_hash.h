// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "skein/base/hash.h"
#include "skein/data/event/record.h"

namespace skein::record {

/// The fingerprint of everything a recorder is given, in that order: of the canonical
/// wire form of each record, so that every described field counts. Numbers count by
/// value; nothing of the machine, the wall clock or the form of storage enters.
class ContentHash {
 public:
  void add(const Record& record);

  /// The fingerprint of all so far: 32 hexadecimal digits.
  std::string hex() const { return hasher_.hex(); }

 private:
  Hasher hasher_;
  std::vector<std::byte> coded_;  // of one record; its memory is used again
};

}  // namespace skein::record
