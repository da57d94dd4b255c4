// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/token_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace skein::hmi {
namespace {

constexpr std::size_t kMaxTokenFile = 1 << 20;  // [bytes]
constexpr mode_t kOthers = 077;                 // what group and others may do

// Closes when it goes.
struct OpenTokens {
  int descriptor;
  ~OpenTokens() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

// Asked of the open file, so that it is the one that is read.
Result<void> check_owner_alone(int descriptor, const std::string& file) {
  struct stat about {};
  if (::fstat(descriptor, &about) != 0)
    return Error{ErrorCode::kNotFound, file, "the file with tokens cannot be read.", ""};
  if (S_ISDIR(about.st_mode))
    return Error{ErrorCode::kBadInput, file, "it is a folder, not a file with tokens.",
                 ""};
  if ((about.st_mode & kOthers) != 0)
    return Error{ErrorCode::kBadInput, file,
                 fmt::format("others than its owner can read or change the tokens (mode "
                             "{:04o}).",
                             about.st_mode & 07777),
                 "Take that from them: chmod 600 " + file};
  if (about.st_uid != ::geteuid() && about.st_uid != 0)
    return Error{ErrorCode::kBadInput, file,
                 "the tokens belong to another user, who can change them.",
                 "Make them yours: a copy of your own, with mode 600."};
  return {};
}

}  // namespace

Result<AccessTable> read_token_file(const std::string& file) {
  const OpenTokens tokens{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (tokens.descriptor < 0)
    return Error{
        ErrorCode::kNotFound, file,
        fmt::format("the file with tokens cannot be read: {}.", std::strerror(errno)),
        ""};
  if (auto alone = check_owner_alone(tokens.descriptor, file); !alone)
    return alone.error();
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t count = ::read(tokens.descriptor, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return Error{
          ErrorCode::kNotFound, file,
          fmt::format("the file with tokens cannot be read: {}.", std::strerror(errno)),
          ""};
    if (count == 0) break;
    text.append(part.data(), static_cast<std::size_t>(count));
    if (text.size() > kMaxTokenFile)
      return Error{ErrorCode::kBadInput, file,
                   "more than a megabyte is no file of tokens.", ""};
  }
  return AccessTable::parse(text, file);
}

}  // namespace skein::hmi
