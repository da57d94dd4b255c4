// SPDX-License-Identifier: Apache-2.0
#include "skein/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace skein {
namespace {

constexpr std::size_t kPart = std::size_t{1} << 16;  // read at once [bytes]

Error not_read(const std::filesystem::path& file) {
  if (errno == ENOENT || errno == ENOTDIR)
    return {ErrorCode::kNotFound, file.string(), "there is no such file.", ""};
  if (errno == EISDIR)
    return {ErrorCode::kBadInput, file.string(), "is a folder, not a file.", ""};
  return {ErrorCode::kUnavailable, file.string(),
          fmt::format("cannot be read: {}.", std::strerror(errno)), ""};
}

// A file that is open for reading, closed with this.
class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool is_open() const { return number_ >= 0; }

  // The size of a regular file; 0 for others. [bytes]
  std::size_t size() const {
    struct stat about {};
    if (::fstat(number_, &about) != 0 || !S_ISREG(about.st_mode)) return 0;
    return static_cast<std::size_t>(about.st_size);
  }

  // Bytes read, 0 at the end, below 0 when it fails.
  ssize_t read(char* to, std::size_t bytes) const {
    ssize_t count = -1;
    do count = ::read(number_, to, bytes);
    while (count < 0 && errno == EINTR);
    return count;
  }

 private:
  int number_;
};

}  // namespace

Result<std::string> read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const Descriptor in(file);
  if (!in.is_open()) return not_read(file);
  const Error large{ErrorCode::kBadInput, file.string(),
                    fmt::format("more than {} bytes.", max_bytes), ""};
  const std::size_t size = in.size();
  if (size > max_bytes) return large;
  std::string text;
  // One byte more than there are: the next read finds the end.
  for (std::size_t part = size + 1;; part = kPart) {
    const std::size_t before = text.size();
    text.resize(std::min(before + part, max_bytes + 1));
    const ssize_t count = in.read(text.data() + before, text.size() - before);
    if (count < 0) return not_read(file);
    text.resize(before + static_cast<std::size_t>(count));
    if (count == 0) return text;
    if (text.size() > max_bytes) return large;
  }
}

Result<std::ifstream> open_input(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    errno = EISDIR;
    return not_read(file);
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return not_read(file);
  return in;
}

}  // namespace skein
