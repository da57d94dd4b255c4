// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/line_input.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <string_view>

namespace skein::hmi {

std::vector<std::string> LineInput::take() {
  std::vector<std::string> lines;
  const auto end_line = [&] {
    lines.push_back(too_long_ ? std::string("(too long)") : begun_);
    begun_.clear();
    too_long_ = false;
  };
  while (descriptor_ >= 0) {
    pollfd ready{descriptor_, POLLIN, 0};
    if (poll(&ready, 1, 0) <= 0 || (ready.revents & (POLLIN | POLLHUP)) == 0) break;
    std::array<char, 4096> buffer{};
    const ssize_t count = read(descriptor_, buffer.data(), buffer.size());
    if (count <= 0) {
      descriptor_ = -1;
      if (!begun_.empty() || too_long_) end_line();
      break;
    }
    for (const char c : std::string_view(buffer.data(), static_cast<std::size_t>(count)))
      if (c == '\n')
        end_line();
      else if (begun_.size() < kMaxBytes)
        begun_ += c;
      else
        too_long_ = true;
  }
  return lines;
}

}  // namespace skein::hmi
