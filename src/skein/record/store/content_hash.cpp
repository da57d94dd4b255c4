// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/content_hash.h"

#include "skein/data/describe/wire.h"

namespace skein::record {

void ContentHash::add(const Record& record) {
  wire::encode_canonical(record, coded_);
  hasher_.add(coded_);
}

}  // namespace skein::record
