// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <span>
#include <vector>

#include "app/common/version.h"
#include "skein/base/hash.h"

namespace skein::app {

std::string program_fingerprint() {
  Hasher hasher;
  hasher.add(std::string_view(kVersion));
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<char> part(std::size_t{1} << 20);
  while (program) {
    program.read(part.data(), static_cast<std::streamsize>(part.size()));
    hasher.add(std::as_bytes(
        std::span(part.data(), static_cast<std::size_t>(program.gcount()))));
  }
  return hasher.hex();
}

}  // namespace skein::app
