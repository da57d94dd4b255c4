// SPDX-License-Identifier: Apache-2.0
#include "skein/link/process/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "skein/base/input_file.h"
#include "skein/base/output_file.h"
#include "skein/base/shown_text.h"

namespace skein::process {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto kGrace = 2s;       // from SIGTERM to SIGKILL
constexpr int kMaxLaunch = 1000;  // after which a program counts as started [ms]
constexpr std::streamoff kMaxTail = 16 << 10;  // of a log [bytes]

Error failed(ErrorCode code, const std::string& place, int error) {
  return {code, place, fmt::format("{}.", std::strerror(error)), ""};
}

bool can_run(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

// The file of a program.
Result<std::string> file_of(const std::string& name) {
  std::error_code error;
  if (name.find('/') != std::string::npos) {
    const fs::path file = fs::absolute(name, error);
    if (can_run(file)) return file.string();
    if (!fs::exists(file, error)) return failed(ErrorCode::kNotFound, name, ENOENT);
    return Error{ErrorCode::kBadInput, name, "this file cannot be run.", ""};
  }
  const char* path = std::getenv("PATH");
  std::string_view folders = path ? path : "/usr/bin:/bin";
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const fs::path file = fs::absolute(fs::path(folders.substr(0, end)) / name, error);
    if (can_run(file)) return file.string();
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return Error{ErrorCode::kNotFound, name, "no folder of PATH has this program.", ""};
}

// This program's variables, and others in place of those of the same name.
std::vector<std::string> environment_with(const std::vector<std::string>& changes) {
  const auto name_of = [](std::string_view entry) {
    return entry.substr(0, entry.find('='));
  };
  std::vector<std::string> all = changes;
  for (char** entry = environ; *entry; ++entry)
    if (std::none_of(changes.begin(), changes.end(), [&](const std::string& change) {
          return name_of(change) == name_of(*entry);
        }))
      all.emplace_back(*entry);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Closes itself.
class File {
 public:
  // Moved above the standard ones, which this program may have closed.
  explicit File(int fd) : fd_(fd) {
    if (fd < 0 || fd > STDERR_FILENO) return;
    fd_ = ::fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    ::close(fd);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { close(); }
  int fd() const { return fd_; }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }

 private:
  int fd_;
};

// What a child that cannot become the program reports.
struct Failure {
  bool folder = false;  // it is the folder that is wrong
  int error = 0;
};

// All that the child needs: between fork and exec it may not allocate memory.
struct Launch {
  const char* file;
  char* const* arguments;
  char* const* environment;
  const char* folder;  // null: as it is
  int input, log;
  int report;  // a pipe that closes when the program runs
  pid_t parent;
};

[[noreturn]] void become(const Launch& launch) {
  Failure failure;
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != launch.parent) ::_exit(1);  // it ended before that
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(launch.input, STDIN_FILENO);
  ::dup2(launch.log, STDOUT_FILENO);
  ::dup2(launch.log, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  if (launch.folder && ::chdir(launch.folder) != 0)
    failure.folder = true;
  else
    ::execve(launch.file, launch.arguments, launch.environment);
  failure.error = errno;
  [[maybe_unused]] const auto written = ::write(launch.report, &failure, sizeof failure);
  ::_exit(127);
}

// A copy of this process that becomes the program. Signals wait meanwhile, so that none
// of this program's handlers runs in the copy.
pid_t fork_into(const Launch& launch) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t process = ::fork();
  if (process == 0) become(launch);
  const int error = errno;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return process;
}

// What the child reports when it fails. The pipe closes when the program runs; not so
// while another thread's fork holds it too.
Failure read_report(int pipe) {
  Failure failure;
  pollfd ready{pipe, POLLIN, 0};
  if (::poll(&ready, 1, kMaxLaunch) <= 0 ||
      ::read(pipe, &failure, sizeof failure) != static_cast<ssize_t>(sizeof failure))
    return {};
  return failure;
}

}  // namespace

std::string ProcessStatus::text() const {
  if (running) return "running";
  if (signal == 0) return fmt::format("ended with {}", exit_code);
  const char* name = ::sigabbrev_np(signal);
  return name ? fmt::format("killed by signal {}", name)
              : fmt::format("killed by signal {}", signal);
}

Result<ChildProcess> ChildProcess::start(const Program& program) {
  if (program.arguments.empty())
    return Error{ErrorCode::kBadInput, "", "no program is named.", ""};
  const std::string& name = program.arguments.front();
  const auto file = file_of(name);
  if (!file) return file.error();
  const File input(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const auto opened = open_for_program(program.log);
  if (!opened) return opened.error();
  const File log(opened.value());
  int ends[2];
  if (input.fd() < 0 || ::pipe2(ends, O_CLOEXEC) != 0)
    return failed(ErrorCode::kUnavailable, name, errno);
  const File reading(ends[0]);
  File writing(ends[1]);

  std::vector<std::string> arguments = program.arguments;
  std::vector<std::string> environment = environment_with(program.environment);
  const std::vector<char*> argv = pointers_to(arguments), envp = pointers_to(environment);
  const Launch launch{
      file.value().c_str(), argv.data(),
      envp.data(),          program.folder.empty() ? nullptr : program.folder.c_str(),
      input.fd(),           log.fd(),
      writing.fd(),         ::getpid()};
  const pid_t process = fork_into(launch);
  if (process < 0) return failed(ErrorCode::kUnavailable, name, errno);
  writing.close();
  const Failure failure = read_report(reading.fd());
  ChildProcess child(process, program.log);  // ends what has failed
  if (failure.error == 0) return child;
  return failure.folder
             ? failed(ErrorCode::kNotFound, program.folder.string(), failure.error)
             : failed(ErrorCode::kBadInput, name, failure.error);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      log_(std::move(other.log_)),
      status_(other.status_),
      stop_due_(other.stop_due_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  ChildProcess taken(std::move(other));  // ends the one that was here
  std::swap(process_, taken.process_);
  std::swap(log_, taken.log_);
  std::swap(status_, taken.status_);
  std::swap(stop_due_, taken.stop_due_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (process_ < 0) return;
  kill_group(SIGKILL);
  // A killed process is gone at once, but for one that waits for a broken disk.
  for (int k = 0; k < 100 && !reap(); ++k) ::poll(nullptr, 0, 10);
}

void ChildProcess::kill_group(int signal) const {
  ::kill(-process_, signal);
}

bool ChildProcess::reap() {
  siginfo_t info{};
  const auto id = static_cast<id_t>(process_);
  // It stays a zombie for now, so that its number is nobody else's.
  if (::waitid(P_PID, id, &info, WEXITED | WNOHANG | WNOWAIT) == 0) {
    if (info.si_pid == 0) return false;
    kill_group(SIGKILL);
    ::waitid(P_PID, id, &info, WEXITED);
    (info.si_code == CLD_EXITED ? status_.exit_code : status_.signal) = info.si_status;
  }  // else somebody else has waited for it
  status_.running = false;
  process_ = -1;
  return true;
}

const ProcessStatus& ChildProcess::look(Clock::time_point now) {
  if (process_ < 0 || reap()) return status_;
  if (stop_due_ && now >= *stop_due_) kill_group(SIGKILL);
  return status_;
}

void ChildProcess::stop(Clock::time_point now) {
  if (process_ < 0 || stop_due_) return;
  stop_due_ = now + kGrace;
  kill_group(SIGTERM);
}

std::vector<std::string> ChildProcess::last_lines(std::size_t count) const {
  std::error_code none;
  if (!fs::is_regular_file(log_, none)) return {};  // a pipe is somebody else's to read
  auto opened = open_input(log_);
  if (!opened) return {};
  std::ifstream& log = opened.value();
  log.seekg(0, std::ios::end);
  const std::streamoff begin = std::max<std::streamoff>(log.tellg() - kMaxTail, 0);
  std::string text(static_cast<std::size_t>(kMaxTail), '\0');
  log.seekg(begin);
  log.read(text.data(), kMaxTail);
  text.resize(static_cast<std::size_t>(log.gcount()));
  if (text.ends_with('\n')) text.pop_back();

  std::vector<std::string> lines;
  std::string_view rest = text;
  while (!rest.empty() && lines.size() < count) {
    const std::size_t before = rest.rfind('\n');
    lines.push_back(shown(rest.substr(before + 1)));  // npos + 1 is 0
    rest = rest.substr(0, before == std::string_view::npos ? 0 : before);
  }
  std::reverse(lines.begin(), lines.end());
  return lines;
}

}  // namespace skein::process
