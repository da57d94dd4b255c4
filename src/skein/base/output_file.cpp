// SPDX-License-Identifier: Apache-2.0
#include "skein/base/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <utility>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;  // followed one after the other, as Linux does
constexpr timespec kReaderPause{0, 20'000'000};  // between two looks for a reader

Error not_written(const fs::path& file, const std::string& reason) {
  return {ErrorCode::kUnavailable, file.string(), "cannot be written: " + reason + ".",
          "Is the folder writable, the disk full?"};
}
Error not_written(const fs::path& file, int code) {
  if (code == EINTR)
    return {ErrorCode::kInterrupted, file.string(),
            "waited for who reads it until a signal came.", ""};
  return not_written(file, std::string(std::strerror(code)));
}

// Waits until a pipe or a device takes more; false, with EINTR, when a signal has come.
bool wait_for_room(int fd) {
  pollfd there{fd, POLLOUT, 0};
  return ::poll(&there, 1, -1) >= 0;
}

// errno, or 0.
int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN && wait_for_room(fd)) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

class OutputDescriptor {
 public:
  explicit OutputDescriptor(int fd) : fd_(fd) {}
  ~OutputDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  OutputDescriptor(const OutputDescriptor&) = delete;
  OutputDescriptor& operator=(const OutputDescriptor&) = delete;

  int fd() const { return fd_; }
  int write(std::string_view text) const { return write_all(fd_, text); }
  int close() {
    const int closed = ::close(fd_);
    fd_ = -1;
    return closed == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

// The descriptor of this process that a path names: /dev/fd/3, /proc/self/fd/3.
std::optional<int> own_descriptor(const fs::path& path) {
  const std::string text = path.lexically_normal().string();
  const std::string own = "/proc/" + std::to_string(::getpid()) + "/fd/";
  for (const std::string& folder :
       {std::string("/proc/self/fd/"), std::string("/proc/thread-self/fd/"),
        std::string("/dev/fd/"), own}) {
    if (!text.starts_with(folder)) continue;
    int number = 0;
    const char* end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + folder.size(), end, number);
    if (error == std::errc() && read == end) return number;
  }
  return std::nullopt;
}

// What a path comes to when its links are followed.
struct Target {
  fs::path path;
  std::optional<int> descriptor;  // of this process
  struct stat state = {};
  bool is_there = false;
};

Result<Target> target_of(const fs::path& file) {
  Target target;
  target.path = file;
  for (int k = 0; k < kMaxLinks; ++k) {
    target.descriptor = own_descriptor(target.path);
    if (target.descriptor) {
      target.is_there = ::fstat(*target.descriptor, &target.state) == 0;
      if (target.is_there) return target;
      return not_written(file, errno);
    }
    if (::lstat(target.path.c_str(), &target.state) != 0) {
      if (errno == ENOENT) return target;  // its folder may be missing: opening says so
      return not_written(file, errno);
    }
    target.is_there = true;
    if (!S_ISLNK(target.state.st_mode)) return target;
    std::error_code failed;
    const fs::path named = fs::read_symlink(target.path, failed);
    if (failed) return not_written(file, failed.message());
    target.path = target.path.parent_path() / named;  // an absolute one stands alone
    target.is_there = false;
  }
  return not_written(file, ELOOP);
}

Result<OutputPlace> place_of(const fs::path& file, const Target& target) {
  if (target.descriptor) return OutputPlace::kThrough;
  if (!target.is_there || S_ISREG(target.state.st_mode)) return OutputPlace::kReplaced;
  if (S_ISDIR(target.state.st_mode)) return not_written(file, EISDIR);
  if (S_ISSOCK(target.state.st_mode)) return not_written(file, "it is a socket");
  return OutputPlace::kThrough;
}

// A new file beside the target, which nobody else has; its name stays short however long
// the target's is.
Result<fs::path> make_beside(const fs::path& file, const Target& target, int& fd) {
  for (int k = 0;; ++k) {
    const fs::path path =
        target.path.parent_path() /
        (".skein-" + std::to_string(::getpid()) + "-" + std::to_string(k) + ".part");
    fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd >= 0) return path;
    if (errno != EEXIST || k > 10'000) return not_written(file, errno);
  }
}

// What was there keeps its permissions. The owner first: that may clear some of them.
void keep_permissions(int fd, const Target& target) {
  if (!target.is_there) return;
  if (::fchown(fd, target.state.st_uid, target.state.st_gid) != 0)
    static_cast<void>(::fchown(fd, static_cast<uid_t>(-1), target.state.st_gid));
  static_cast<void>(::fchmod(fd, target.state.st_mode & 07777));
}

Result<void> replace(const fs::path& file, const Target& target, std::string_view text) {
  int fd = -1;
  const auto beside = make_beside(file, target, fd);
  if (!beside) return beside.error();
  OutputDescriptor out(fd);
  keep_permissions(fd, target);
  int failed = out.write(text);
  if (const int closed = out.close(); failed == 0) failed = closed;
  if (failed == 0 && ::rename(beside.value().c_str(), target.path.c_str()) == 0)
    return {};
  const int code = failed != 0 ? failed : errno;
  ::unlink(beside.value().c_str());
  return not_written(file, code);
}

// A pipe or a device, or errno as a negative number. open() would wait for a reader, and
// go on waiting when a signal comes. Signals come in ppoll() only, so none is missed.
int open_special(const Target& target) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  int fd = -1, failed = 0;
  do {
    fd = ::open(target.path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    failed = fd < 0 ? errno : 0;
    if (failed != ENXIO || !S_ISFIFO(target.state.st_mode)) break;
    if (::ppoll(nullptr, 0, &kReaderPause, &before) < 0) failed = errno;
  } while (failed == ENXIO);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return failed == 0 ? fd : -failed;
}

// For writing to the target as it is, or errno as a negative number. `flags` are for
// regular files.
int open_target(const Target& target, OutputPlace place, int flags) {
  if (target.descriptor == STDOUT_FILENO) std::fflush(stdout);
  if (!target.descriptor && place == OutputPlace::kThrough) return open_special(target);
  const int fd =
      target.descriptor
          ? ::fcntl(*target.descriptor, F_DUPFD_CLOEXEC, 0)
          : ::open(target.path.c_str(), flags | O_WRONLY | O_NOCTTY | O_CLOEXEC, 0666);
  return fd < 0 ? -errno : fd;
}

Result<void> write_through(const fs::path& file, const Target& target,
                           std::string_view text) {
  const int fd = open_target(target, OutputPlace::kThrough, 0);
  if (fd < 0) return not_written(file, -fd);
  OutputDescriptor out(fd);
  const int written = out.write(text);
  const int closed = out.close();
  const int failed = written != 0 ? written : closed;
  return failed == 0 ? Result<void>() : not_written(file, failed);
}

Result<std::string> content_of(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0)
    return Error{ErrorCode::kNotFound, file.string(),
                 std::string("cannot be read: ") + std::strerror(errno) + ".", ""};
  const OutputDescriptor in(fd);
  std::string content;
  std::array<char, 1 << 16> part{};
  for (;;) {
    const ssize_t count = ::read(fd, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return Error{ErrorCode::kNotFound, file.string(),
                   std::string("cannot be read: ") + std::strerror(errno) + ".", ""};
    if (count == 0) return content;
    content.append(part.data(), static_cast<std::size_t>(count));
  }
}

constexpr std::size_t kHeldBytes = 1 << 16;  // of a stream, before they are written

}  // namespace

Result<OutputPlace> output_place(const fs::path& file) {
  const auto target = target_of(file);
  if (!target) return target.error();
  return place_of(file, target.value());
}

Result<void> write_file(const fs::path& file, std::string_view text) {
  const auto target = target_of(file);
  if (!target) return target.error();
  const auto place = place_of(file, target.value());
  if (!place) return place.error();
  if (place.value() == OutputPlace::kThrough)
    return write_through(file, target.value(), text);
  return replace(file, target.value(), text);
}

Result<void> write_file(const fs::path& file, std::span<const std::byte> bytes) {
  return write_file(
      file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

Result<void> move_into_place(const fs::path& finished, const fs::path& file) {
  const auto target = target_of(file);
  if (!target) return target.error();
  const auto place = place_of(file, target.value());
  if (!place) return place.error();
  if (place.value() == OutputPlace::kReplaced) {
    const int fd = ::open(finished.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd >= 0) {
      keep_permissions(fd, target.value());
      ::close(fd);
    }
    if (::rename(finished.c_str(), target.value().path.c_str()) == 0) return {};
    if (errno != EXDEV) return not_written(file, errno);
  }
  // A device, a pipe or another file system: by content.
  auto content = content_of(finished);
  if (!content) return content.error();
  if (auto written = write_file(file, content.value()); !written) return written;
  ::unlink(finished.c_str());
  return {};
}

Result<void> check_writable(const fs::path& file) {
  const auto target = target_of(file);
  if (!target) return target.error();
  const auto place = place_of(file, target.value());
  if (!place) return place.error();
  if (place.value() == OutputPlace::kThrough) {
    if (target.value().descriptor || ::access(target.value().path.c_str(), W_OK) == 0)
      return {};
    return not_written(file, errno);
  }
  int fd = -1;
  const auto beside = make_beside(file, target.value(), fd);
  if (!beside) return beside.error();
  ::close(fd);
  ::unlink(beside.value().c_str());
  return {};
}

Result<int> open_for_program(const fs::path& file) {
  const auto target = target_of(file);
  if (!target) return target.error();
  const auto place = place_of(file, target.value());
  if (!place) return place.error();
  if (target.value().descriptor || place.value() == OutputPlace::kReplaced) {
    const int fd =
        open_target(target.value(), place.value(), O_CREAT | O_TRUNC | O_APPEND);
    return fd < 0 ? Result<int>(not_written(file, -fd)) : fd;
  }
  const int fd =
      ::open(target.value().path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (fd < 0 && errno == ENXIO && S_ISFIFO(target.value().state.st_mode))
    return Error{ErrorCode::kUnavailable, file.string(),
                 "cannot be written: nobody reads this pipe.",
                 "Start what reads it first."};
  if (fd < 0) return not_written(file, errno);
  // A program expects that writing waits.
  static_cast<void>(::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK));
  return fd;
}

Result<OutputStream> OutputStream::open(const fs::path& file) {
  return begin(file, O_CREAT | O_TRUNC);
}

Result<OutputStream> OutputStream::append(const fs::path& file) {
  return begin(file, O_CREAT | O_APPEND);
}

Result<OutputStream> OutputStream::begin(const fs::path& file, int flags) {
  const auto target = target_of(file);
  if (!target) return target.error();
  const auto place = place_of(file, target.value());
  if (!place) return place.error();
  const int fd = open_target(target.value(), place.value(), flags);
  if (fd < 0) return not_written(file, -fd);
  OutputStream stream;
  stream.file_ = file;
  stream.fd_ = fd;
  return stream;
}

OutputStream::OutputStream(OutputStream&& other) noexcept
    : file_(std::move(other.file_)),
      fd_(std::exchange(other.fd_, -1)),
      failed_(other.failed_),
      held_(std::move(other.held_)) {}

OutputStream& OutputStream::operator=(OutputStream&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(fd_, other.fd_);
  std::swap(failed_, other.failed_);
  std::swap(held_, other.held_);
  return *this;
}

OutputStream::~OutputStream() {
  if (fd_ >= 0) ::close(fd_);
}

void OutputStream::write(std::string_view text) {
  if (fd_ < 0 || failed_ != 0) return;
  held_ += text;
  if (held_.size() >= kHeldBytes) static_cast<void>(flush());
}

Result<void> OutputStream::flush() {
  if (fd_ < 0) return {};
  if (failed_ == 0) failed_ = write_all(fd_, held_);
  held_.clear();
  return failed_ == 0 ? Result<void>() : not_written(file_, failed_);
}

}  // namespace skein
