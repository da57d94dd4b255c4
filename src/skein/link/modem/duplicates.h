#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include "skein/base/time.h"

namespace skein::modem {

/// Tells what has come before from what is new, by origin, its session and number.
///
/// Of each origin the newest number and the 64 before it are known; what is older counts
/// as known. A session that is older than the present one is not heard while that one is
/// (ten seconds). At most 1000 origins: nobody can make it hold more.
class Duplicates {
 public:
  /// Whether this is heard for the first time.
  bool is_new(std::uint32_t origin, std::uint64_t session, std::uint64_t number,
              Time now);

 private:
  struct Origin {
    std::uint64_t session = 0, newest = 0;
    std::uint64_t before = 0;  // bit k: newest - 1 - k has come
    Time heard;
  };
  std::map<std::uint32_t, Origin> origins_;
};

}  // namespace skein::modem
