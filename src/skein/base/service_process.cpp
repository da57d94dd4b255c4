// SPDX-License-Identifier: Apache-2.0
#include "skein/base/service_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <utility>

namespace skein {
namespace {

constexpr int kPatience = 300'000;                    // for an answer [ms]
constexpr rlim_t kProcessorTime = 120;                // [s]
constexpr rlim_t kMemory = rlim_t{2} << 30;           // beyond the beginning [bytes]
constexpr std::uint64_t kMaxTexts = 10'000'000;       // in one message
constexpr std::uint64_t kMaxText = 100'000'000;       // [bytes]
constexpr std::uint64_t kMaxNumbers = 1'000'000'000;  // in one message
constexpr std::size_t kChunk = std::size_t{1} << 20;  // [bytes]

bool send_all(int socket, const void* data, std::size_t size) {
  const auto* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, at, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool send_count(int socket, std::uint64_t count) {
  return send_all(socket, &count, sizeof count);
}

bool send_message(int socket, const ServiceMessage& message) {
  bool good = send_count(socket, message.texts.size()) &&
              send_count(socket, message.numbers.size());
  for (const std::string& text : message.texts)
    good = good && send_count(socket, text.size()) &&
           send_all(socket, text.data(), text.size());
  return good && send_all(socket, message.numbers.data(),
                          message.numbers.size() * sizeof(double));
}

// Waits no longer than `patience` for each piece [ms].
bool receive_all(int socket, void* data, std::size_t size, int patience) {
  auto* at = static_cast<char*>(data);
  while (size > 0) {
    pollfd ready{socket, POLLIN, 0};
    const int waited = ::poll(&ready, 1, patience);
    if (waited < 0 && errno == EINTR) continue;
    if (waited <= 0) return false;
    const ssize_t got = ::recv(socket, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// Grows with what arrives, so that a wrong size takes no memory.
template <class Container>
bool receive_content(int socket, Container& to, std::uint64_t size, int patience) {
  constexpr std::size_t kOne = sizeof(typename Container::value_type);
  while (to.size() < size) {
    const std::size_t before = to.size();
    to.resize(std::min<std::size_t>(size, before + std::max(before, kChunk / kOne)));
    if (!receive_all(socket, to.data() + before, (to.size() - before) * kOne, patience))
      return false;
  }
  return true;
}

std::optional<ServiceMessage> receive_message(int socket, int patience) {
  const auto count = [&](std::uint64_t limit) -> std::optional<std::uint64_t> {
    std::uint64_t value = 0;
    if (!receive_all(socket, &value, sizeof value, patience) || value > limit) return {};
    return value;
  };
  const auto texts = count(kMaxTexts);
  const auto numbers = texts ? count(kMaxNumbers) : std::nullopt;
  if (!numbers) return std::nullopt;
  ServiceMessage message;
  for (std::uint64_t i = 0; i < *texts; ++i) {
    const auto size = count(kMaxText);
    if (!size || !receive_content(socket, message.texts.emplace_back(), *size, patience))
      return std::nullopt;
  }
  if (!receive_content(socket, message.numbers, *numbers, patience)) return std::nullopt;
  return message;
}

void limit(__rlimit_resource what, rlim_t max) {
  rlimit limits{};
  if (getrlimit(what, &limits) != 0) return;
  limits.rlim_cur = std::min(limits.rlim_max, max);
  setrlimit(what, &limits);
}

// Of the address space of this process [bytes].
rlim_t size_now() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

// Waits for a request; false when the owner is gone. Other copies may hold the other end
// of this socket too, so that alone is no proof.
bool request_comes(int socket, pid_t owner) {
  constexpr int kBetweenLooks = 1000;  // [ms]
  pollfd ready{socket, POLLIN, 0};
  while (::getppid() == owner)
    if (::poll(&ready, 1, kBetweenLooks) > 0) return true;
  return false;
}

// What libraries have open stays open: they may be in the middle of it.
[[noreturn]] void serve(int socket, pid_t owner, const ServiceProcess::Answer& answer) {
  if (const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC); nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM})
    ::signal(signal, signal == SIGINT ? SIG_IGN : SIG_DFL);  // the owner is asked to stop
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, kProcessorTime);
  limit(RLIMIT_AS, size_now() + kMemory);
  try {
    while (request_comes(socket, owner)) {
      const auto request = receive_message(socket, kPatience);
      if (!request || !send_message(socket, answer(*request))) break;
    }
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

}  // namespace

Result<ServiceProcess> ServiceProcess::start(const Answer& answer) {
  const auto failed = [] {
    return Error{
        ErrorCode::kUnavailable, "",
        fmt::format("no process can be made to read it in: {}.", std::strerror(errno)),
        ""};
  };
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return failed();
  const pid_t owner = ::getpid();
  const pid_t process = ::fork();
  if (process == 0) {
    ::close(ends[0]);
    serve(ends[1], owner, answer);
  }
  ::close(ends[1]);
  if (process < 0) {
    ::close(ends[0]);
    return failed();
  }
  return ServiceProcess(process, ends[0]);
}

ServiceProcess::ServiceProcess(ServiceProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      socket_(std::exchange(other.socket_, -1)) {}

ServiceProcess& ServiceProcess::operator=(ServiceProcess&& other) noexcept {
  if (this == &other) return *this;
  end();
  process_ = std::exchange(other.process_, -1);
  socket_ = std::exchange(other.socket_, -1);
  return *this;
}

ServiceProcess::~ServiceProcess() {
  end();
}

void ServiceProcess::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

// What became of a process that does not answer.
Error ServiceProcess::ended() {
  ::close(std::exchange(socket_, -1));
  int status = 0;
  pid_t waited = 0;
  // It has closed its end, and is gone at once; or it hangs.
  for (int i = 0; i < 100 && waited == 0; ++i) {
    waited = ::waitpid(process_, &status, WNOHANG);
    if (waited == 0) ::poll(nullptr, 0, 10);
  }
  if (waited != 0) process_ = -1;
  const bool killed = waited > 0 && WIFSIGNALED(status);
  const bool slow = waited == 0 || (killed && WTERMSIG(status) == SIGXCPU);
  end();
  return {ErrorCode::kBadInput, "",
          slow     ? "it takes longer than anything whole"
          : killed ? fmt::format("its reader crashed ({})", sigdescr_np(WTERMSIG(status)))
                   : "its reader ran out of memory or failed",
          ""};
}

Result<ServiceMessage> ServiceProcess::ask(const ServiceMessage& request) {
  if (socket_ < 0)
    return Error{ErrorCode::kBadInput, "", "its reader has ended before", ""};
  if (send_message(socket_, request))
    if (auto answer = receive_message(socket_, kPatience)) return *std::move(answer);
  return ended();
}

}  // namespace skein
