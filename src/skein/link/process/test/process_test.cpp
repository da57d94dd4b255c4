// SPDX-License-Identifier: Apache-2.0
#include "skein/link/process/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

namespace skein::process::process_test {
namespace {

using namespace std::chrono_literals;
using Clock = ChildProcess::Clock;
namespace fs = std::filesystem;

class ChildProcesses : public testing::Test {
 protected:
  ChildProcesses() { fs::create_directories(folder_); }
  ~ChildProcesses() override { fs::remove_all(folder_); }

  Program program(std::vector<std::string> arguments) const {
    return {std::move(arguments), {}, folder_ / "log", {}};
  }
  Program shell(const std::string& script) const { return program({"sh", "-c", script}); }
  static ChildProcess started(const Program& program) {
    auto child = ChildProcess::start(program);
    EXPECT_TRUE(child.ok()) << (child.ok() ? "" : child.error().text());
    return std::move(child).value();
  }
  // Waits for up to 20 s.
  static bool wait(const std::function<bool()>& until) {
    for (int k = 0; k < 2000 && !until(); ++k) std::this_thread::sleep_for(10ms);
    return until();
  }
  static bool wait_for_end(ChildProcess& child) {
    return wait([&] { return !child.look(Clock::now()).running; });
  }
  // Whether a process lives; a zombie does not.
  static bool lives(pid_t id) {
    std::ifstream in("/proc/" + std::to_string(id) + "/stat");
    std::string text;
    std::getline(in, text);
    const std::size_t name_end = text.rfind(')');
    return name_end != std::string::npos && text[name_end + 2] != 'Z';
  }
  // A number that a script has written to a file, once it is there.
  pid_t number_in(const fs::path& file) const {
    pid_t number = 0;
    wait([&] { return bool(std::ifstream(file) >> number); });
    return number;
  }

  fs::path folder_ =
      fs::path(testing::TempDir()) / ("process" + std::to_string(getpid()));
};

TEST_F(ChildProcesses, SayHowTheyEndedAndWhatTheyWroteLast) {
  auto child =
      started(shell("for i in 1 2 3; do echo line $i; done; echo bad >&2; exit 3"));
  ASSERT_TRUE(wait_for_end(child));
  EXPECT_EQ(child.look(Clock::now()).exit_code, 3);
  EXPECT_EQ(child.look(Clock::now()).text(), "ended with 3");
  EXPECT_EQ(child.last_lines(2), (std::vector<std::string>{"line 3", "bad"}));
  EXPECT_EQ(child.last_lines(99).size(), 4U);
}

TEST_F(ChildProcesses, MayLogIntoAPipeWhichIsNeverWaitedFor) {
  auto logged = shell("echo through");
  logged.log = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(logged.log.c_str(), 0600), 0);
  const auto unread = ChildProcess::start(logged);
  ASSERT_FALSE(unread) << "nobody reads it";
  EXPECT_EQ(unread.error().place, logged.log.string());
  const int reader = ::open(logged.log.c_str(), O_RDONLY | O_NONBLOCK);
  auto child = started(logged);
  ASSERT_TRUE(wait_for_end(child));
  EXPECT_TRUE(child.last_lines(9).empty()) << "its lines are the reader's";
  char text[20] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 8);
  EXPECT_STREQ(text, "through\n");
  ::close(reader);
}

TEST_F(ChildProcesses, WorkInTheirFolderWithTheirVariables) {
  auto wanted = shell("pwd; echo $SKEIN_A $SKEIN_B; cat");
  wanted.folder = folder_;
  wanted.environment = {"SKEIN_A=one", "SKEIN_B=two words"};
  ::setenv("SKEIN_A", "replaced", 1);
  auto child = started(wanted);
  ::unsetenv("SKEIN_A");
  ASSERT_TRUE(wait_for_end(child));  // cat has nothing to read
  EXPECT_EQ(child.last_lines(9),
            (std::vector<std::string>{fs::canonical(folder_).string(), "one two words"}));
}

TEST_F(ChildProcesses, HaveNoOpenFilesOfTheirOwner) {
  const int left_open = ::open("/dev/null", O_RDONLY);  // without close-on-exec
  auto child = started(shell("ls /proc/$$/fd"));
  ASSERT_TRUE(wait_for_end(child));
  EXPECT_EQ(child.last_lines(9), (std::vector<std::string>{"0", "1", "2"}));
  ::close(left_open);
}

TEST_F(ChildProcesses, ShowOnlyTheEndOfALongLogFitForATerminal) {
  auto child = started(shell("seq 100000; printf 'bell\\a\\n'"));
  ASSERT_TRUE(wait_for_end(child));
  const auto lines = child.last_lines(1'000'000);
  EXPECT_LT(lines.size(), 4000U);
  ASSERT_GT(lines.size(), 1000U);
  EXPECT_EQ(lines.back(), "bell\\x07");
  EXPECT_EQ(lines[lines.size() - 2], "100000");
}

TEST_F(ChildProcesses, EndWhenAsked) {
  auto child = started(program({"sleep", "1000"}));
  EXPECT_TRUE(child.look(Clock::now()).running);
  child.stop(Clock::now());
  ASSERT_TRUE(wait_for_end(child));
  EXPECT_EQ(child.look(Clock::now()).text(), "killed by signal TERM");
}

TEST_F(ChildProcesses, AreKilledWhenTheyIgnoreBeingAsked) {
  auto child = started(shell("trap '' TERM; echo ready; while :; do sleep 0.01; done"));
  ASSERT_TRUE(wait([&] { return child.last_lines(1).size() == 1; }));
  const Clock::time_point asked = Clock::now();
  child.stop(asked);
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(child.look(asked + 1999ms).running);
  child.stop(asked + 1999ms);  // does not begin the two seconds anew
  child.look(asked + 2s);
  ASSERT_TRUE(wait([&] { return !child.look(asked + 2s).running; }));
  EXPECT_EQ(child.look(asked + 2s).signal, SIGKILL);
}

TEST_F(ChildProcesses, KilledFromOutsideSaySo) {
  auto child = started(program({"sleep", "1000"}));
  ASSERT_EQ(::kill(child.id(), SIGKILL), 0);
  ASSERT_TRUE(wait_for_end(child));
  EXPECT_EQ(child.look(Clock::now()).text(), "killed by signal KILL");
}

TEST_F(ChildProcesses, TakeWhatTheyStartedWithThem) {
  const std::string script =
      "(trap '' TERM; exec sleep 1000) & echo $! > " + (folder_ / "other").string();
  {
    auto child = started(shell(script + "; wait"));
    const pid_t other = number_in(folder_ / "other");
    ASSERT_TRUE(lives(other));
    child.stop(Clock::now());  // ends the shell only
    ASSERT_TRUE(wait_for_end(child));
    EXPECT_TRUE(wait([&] { return !lives(other); }));
  }
  fs::remove(folder_ / "other");
  pid_t other = 0;
  {
    auto child = started(shell(script + "; wait"));
    other = number_in(folder_ / "other");
    ASSERT_TRUE(lives(other));
  }
  EXPECT_TRUE(wait([&] { return !lives(other); }));
}

TEST_F(ChildProcesses, LeaveNoZombies) {
  pid_t id = 0;
  {
    auto child = started(program({"true"}));
    id = child.id();
    ASSERT_TRUE(wait_for_end(child));
    EXPECT_EQ(::kill(id, 0), -1);
    auto other = started(program({"sleep", "1000"}));
    id = other.id();
    child = std::move(other);
    EXPECT_EQ(child.id(), id);
    EXPECT_TRUE(lives(id));
  }
  EXPECT_EQ(::kill(id, 0), -1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(ChildProcesses, DieWithTheirParent) {
  const fs::path file = folder_ / "id";
  const pid_t parent = ::fork();
  if (parent == 0) {
    auto child =
        ChildProcess::start(shell("echo $$ > " + file.string() + "; exec sleep 1000"));
    ::pause();
    ::_exit(child.ok() ? 0 : 1);
  }
  const pid_t id = number_in(file);
  ASSERT_GT(id, 0);
  EXPECT_TRUE(lives(id));
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  EXPECT_TRUE(wait([&] { return !lives(id); }));
}

TEST_F(ChildProcesses, AreNotStartedWhereThatIsNoProgram) {
  const auto code_of = [](const Program& program) {
    const auto child = ChildProcess::start(program);
    return child.ok() ? ErrorCode::kInternal : child.error().code;
  };
  EXPECT_EQ(code_of(program({})), ErrorCode::kBadInput);
  EXPECT_EQ(code_of(program({"skein-has-no-such-program"})), ErrorCode::kNotFound);
  EXPECT_EQ(code_of(program({"./no-such-program"})), ErrorCode::kNotFound);
  EXPECT_EQ(code_of(program({"/"})), ErrorCode::kBadInput);
  const fs::path file = folder_ / "no-program";
  std::ofstream(file) << "neither machine code nor a script\n";
  EXPECT_EQ(code_of(program({file.string()})), ErrorCode::kBadInput);
  fs::permissions(file, fs::perms::owner_all);
  EXPECT_EQ(code_of(program({file.string()})), ErrorCode::kBadInput);
  auto lost = program({"true"});
  lost.folder = folder_ / "nowhere";
  EXPECT_EQ(code_of(lost), ErrorCode::kNotFound);
  lost = program({"true"});
  lost.log = folder_ / "nowhere" / "log";
  EXPECT_EQ(code_of(lost), ErrorCode::kUnavailable);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // nothing is left of them
}

TEST_F(ChildProcesses, NeverKeepTheirOwnerWaiting) {
  const Clock::time_point before = Clock::now();
  {
    auto child = started(shell("trap '' TERM; while :; do sleep 0.01; done"));
    child.look(Clock::now());
    child.stop(Clock::now());
    child.last_lines(5);
  }
  EXPECT_LT(Clock::now() - before, 1500ms);  // it would end by itself after two seconds
}

}  // namespace
}  // namespace skein::process::process_test
