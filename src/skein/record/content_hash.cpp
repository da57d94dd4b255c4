#include "skein/record/content_hash.h"

#include "skein/data/wire.h"

namespace skein::record {

void ContentHash::add(const Record& record) {
  wire::encode_canonical(record, coded_);
  hasher_.add(coded_);
}

}  // namespace skein::record
