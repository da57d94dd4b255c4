// SPDX-License-Identifier: Apache-2.0
#include "skein/base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
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
  if (errno == EINTR)
    return {ErrorCode::kUnavailable, file.string(), "was waited for until a signal came.",
            ""};
  if (errno == EISDIR)
    return {ErrorCode::kBadInput, file.string(), "is a folder, not a file.", ""};
  return {ErrorCode::kUnavailable, file.string(),
          fmt::format("cannot be read: {}.", std::strerror(errno)), ""};
}

// A file that is open for reading, closed with this.
class Descriptor {
 public:
  // A pipe that nobody has opened for writing does not hold it.
  explicit Descriptor(const std::filesystem::path& file)
      : number_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
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

  // Waits until a pipe has bytes or has been left by its writer; at once for files.
  // False, with EINTR, when a signal has come.
  bool wait() const {
    pollfd here{number_, POLLIN, 0};
    return ::poll(&here, 1, -1) >= 0;
  }

  // Bytes read, 0 at the end, below 0 when it fails or a signal has come.
  ssize_t read(char* to, std::size_t bytes) const {
    for (;;) {
      if (!wait()) return -1;
      const ssize_t count = ::read(number_, to, bytes);
      if (count >= 0 || errno != EAGAIN) return count;
    }
  }

 private:
  int number_;
};

// What comes by a pipe, as a file in memory: a stream of a pipe could not be left by a
// signal before there is a writer.
Result<std::ifstream> open_pipe(const std::filesystem::path& file) {
  auto text = read_file(file);
  if (!text) return text.error();
  const int memory = ::memfd_create("pipe", MFD_CLOEXEC);
  if (memory < 0) return not_read(file);
  std::size_t written = 0;
  while (written < text.value().size()) {
    const ssize_t count =
        ::write(memory, text.value().data() + written, text.value().size() - written);
    if (count < 0 && errno != EINTR) break;
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  std::ifstream in(fmt::format("/proc/self/fd/{}", memory), std::ios::binary);
  ::close(memory);
  if (!in || written < text.value().size()) return not_read(file);
  return in;
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& file, std::size_t max_bytes) {
  const Descriptor in(file);
  if (!in.is_open()) return not_read(file);
  const Error large{ErrorCode::kBadInput, file.string(),
                    fmt::format("more than {} bytes.", max_bytes), ""};
  const std::size_t size = in.size();
  if (size > max_bytes) return large;
  std::string text, part;
  text.reserve(size);  // a text that is kept takes no more than it has
  part.resize(std::clamp(size + 1, std::size_t{1} << 12, kPart));
  for (;;) {
    const ssize_t count = in.read(part.data(), part.size());
    if (count < 0) return not_read(file);
    if (count == 0) return text;
    text.append(part, 0, static_cast<std::size_t>(count));
    if (text.size() > max_bytes) return large;
  }
}

Result<std::ifstream> open_input(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    errno = EISDIR;
    return not_read(file);
  }
  if (std::filesystem::is_fifo(file, ignored)) return open_pipe(file);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return not_read(file);
  return in;
}

}  // namespace skein
