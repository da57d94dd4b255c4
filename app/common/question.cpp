// SPDX-License-Identifier: Apache-2.0
#include "app/common/question.h"

#include <poll.h>
#include <signal.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "app/common/output.h"

namespace skein::app {
namespace {

// A signal that comes between the question and the wait for its answer is not lost: it is
// let through in the wait only.
bool wait_for_answer(const std::string& question) {
  sigset_t held, before;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &held, &before);
  ::tcflush(STDIN_FILENO, TCIFLUSH);
  complain("{} [y/N] ", question);
  pollfd input{STDIN_FILENO, POLLIN, 0};
  const bool interrupted = ::ppoll(&input, 1, nullptr, &before) < 0 && errno == EINTR;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return !interrupted;
}

// The line without its end; empty at an end of file.
std::string read_line() {
  std::string line;
  int c = std::getchar();
  for (; c != EOF && c != '\n'; c = std::getchar()) line += static_cast<char>(c);
  if (c != EOF) return line;
  complain("\n");
  std::clearerr(stdin);
  return {};
}

}  // namespace

bool ask_on_terminal(const std::string& question) {
  if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDERR_FILENO) == 0) return false;
  if (!wait_for_answer(question)) {
    complain("\n");
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
  const std::string answer = read_line();
  return answer == "y" || answer == "Y" || answer == "yes" || answer == "Yes" ||
         answer == "YES";
}

}  // namespace skein::app
