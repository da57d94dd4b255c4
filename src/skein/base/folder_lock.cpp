// SPDX-License-Identifier: Apache-2.0
#include "skein/base/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "skein/base/shown_text.h"

namespace skein {
namespace {

// What a holder has written of itself; it need not have come to that.
std::string written_in(int fd) {
  std::array<char, 100> text{};
  const ssize_t count = ::pread(fd, text.data(), text.size(), 0);
  std::string all(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!all.empty() && all.back() == '\n') all.pop_back();
  return all.empty() ? "another process" : shown(all);
}

int try_lock(int fd, int how) {
  int done = 0;
  do done = ::flock(fd, how | LOCK_NB);
  while (done != 0 && errno == EINTR);
  return done == 0 ? 0 : errno;
}

// holder() has a lock, too, for a moment.
int lock_alone(int fd) {
  constexpr int kTries = 10;
  constexpr auto kPause = std::chrono::milliseconds(10);
  for (int k = 1; k < kTries; ++k) {
    if (const int code = try_lock(fd, LOCK_EX); code != EWOULDBLOCK) return code;
    std::this_thread::sleep_for(kPause);
  }
  return try_lock(fd, LOCK_EX);
}

}  // namespace

Result<FolderLock> FolderLock::take(const std::filesystem::path& folder,
                                    const std::string& what) {
  const std::filesystem::path file = folder / kFileName;
  const auto failed = [&file](int code) {
    return Error{ErrorCode::kUnavailable, file.string(),
                 std::string("the folder cannot be locked: ") + std::strerror(code) + ".",
                 "Choose another folder."};
  };
  FolderLock lock(
      ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
  if (lock.fd_ < 0) return failed(errno);
  struct stat state {};
  if (::fstat(lock.fd_, &state) != 0) return failed(errno);
  if (!S_ISREG(state.st_mode))
    return Error{ErrorCode::kUnavailable, file.string(),
                 "is no regular file, so the folder cannot be locked.",
                 "Remove it, or choose another folder."};
  if (const int code = lock_alone(lock.fd_); code == EWOULDBLOCK)
    return Error{ErrorCode::kBadInput, folder.string(),
                 written_in(lock.fd_) + " writes there now.",
                 "Wait for its end, or choose another folder."};
  else if (code != 0)
    return failed(code);
  const std::string self = what + " (process " + std::to_string(::getpid()) + ")\n";
  if (::ftruncate(lock.fd_, 0) != 0 ||
      ::pwrite(lock.fd_, self.data(), self.size(), 0) < 0)
    return failed(errno);
  return lock;
}

std::optional<std::string> FolderLock::holder(const std::filesystem::path& folder) {
  const FolderLock lock(::open((folder / kFileName).c_str(),
                               O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (lock.fd_ < 0 || try_lock(lock.fd_, LOCK_SH) != EWOULDBLOCK) return std::nullopt;
  return written_in(lock.fd_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

FolderLock::~FolderLock() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace skein
