// SPDX-License-Identifier: Apache-2.0
#include "app/common/output.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "app/common/commands.h"

namespace skein::app {
namespace {

int lost_because = 0;  // errno of the first write that failed; 0 = none did

// Whether standard output is a pipe that nobody reads any more.
bool reader_has_gone() {
  pollfd out{STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & (POLLERR | POLLHUP)) != 0;
}

}  // namespace

void put_out(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) < text.size() && lost_because == 0)
    lost_because = errno;
}

bool put_out_now(std::string_view text) {
  put_out(text);
  errno = 0;
  if (std::fflush(stdout) != 0 && lost_because == 0) lost_because = errno;
  return std::ferror(stdout) == 0;
}

void put_err(std::string_view text) {
  const std::string safe = shown(text);
  std::fwrite(safe.data(), 1, safe.size(), stderr);
}

int finish_output(int status) {
  errno = 0;
  if (std::fflush(stdout) != 0 && lost_because == 0) lost_because = errno;
  if (std::ferror(stdout) == 0 || reader_has_gone()) return status;
  put_err("error: standard output cannot be written");
  if (lost_because != 0) complain(": {}", std::strerror(lost_because));
  put_err(". What was to be printed is lost.\n");
  return status == kDone ? kFailed : status;
}

}  // namespace skein::app
