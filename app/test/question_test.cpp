// SPDX-License-Identifier: Apache-2.0
// Whoever starts a scenario that names code is asked on a terminal: here a pseudo
// terminal, with what people type into it.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>

#include "app/test/program.h"

namespace skein::app {
namespace {

using Words = std::vector<std::string>;

class Question : public Program {
 protected:
  Question() {
    setenv("SKEIN_MARKER", marker().c_str(), 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  }
  ~Question() override {
    unsetenv("SKEIN_MARKER");
    unsetenv("XDG_CONFIG_HOME");
  }

  fs::path marker() const { return folder_ / "marker"; }
  bool was_run() {
    const bool there = fs::exists(marker());
    fs::remove(marker());
    return there;
  }

  struct Answered {
    int status = -1;     // exit status, or -signal
    int questions = 0;   // that were asked
    std::string screen;  // all that was shown
  };

  // Starts the program on a terminal of its own, where `early` is typed before it asks
  // and `typed` at each question.
  Answered answer(const Words& arguments, const std::string& typed,
                  const std::string& early = "") {
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    EXPECT_GE(terminal, 0);
    EXPECT_EQ(grantpt(terminal) + unlockpt(terminal), 0);
    const std::string name = ptsname(terminal);
    type(terminal, early);
    const pid_t child = fork();
    if (child == 0) run_on(name, arguments);
    Answered result;
    std::size_t seen = 0;
    char bytes[1000];
    pollfd input{terminal, POLLIN, 0};
    while (poll(&input, 1, 60'000) == 1) {
      const ssize_t size = read(terminal, bytes, sizeof bytes);
      if (size <= 0) break;  // EIO: nobody has it open any more
      result.screen.append(bytes, static_cast<std::size_t>(size));
      const std::size_t prompt = result.screen.find("[y/N] ", seen);
      if (prompt == std::string::npos) continue;
      seen = prompt + 1;
      ++result.questions;
      type(terminal, typed);
    }
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return result;
  }

  static Words check() { return {"check", "evil.yaml"}; }
  void write_library_scenario() {
    write("evil.yaml",
          "name: evil\nduration_s: 2\nplugins: ['" SKEIN_MARKER_LIBRARY "']\n");
  }

 private:
  static void type(int terminal, const std::string& text) {
    EXPECT_EQ(::write(terminal, text.data(), text.size()),
              static_cast<ssize_t>(text.size()));
  }

  // In the child: the terminal is its own, so that Ctrl-C reaches it.
  [[noreturn]] void run_on(const std::string& terminal, Words arguments) {
    std::string program = SKEIN_PROGRAM;
    std::vector<char*> argv{program.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    setsid();
    const int slave = open(terminal.c_str(), O_RDWR);  // the first becomes the session's
    const int out = open("/dev/null", O_WRONLY);
    if (slave < 0 || out < 0 || chdir(folder_.c_str()) != 0) _exit(99);
    dup2(slave, STDIN_FILENO);
    dup2(slave, STDERR_FILENO);
    dup2(out, STDOUT_FILENO);
    if (slave > STDERR_FILENO) close(slave);
    execv(SKEIN_PROGRAM, argv.data());
    _exit(99);
  }
};

TEST_F(Question, OnlyYesLoadsALibrary) {
  write_library_scenario();
  for (const char* yes : {"y\n", "Y\n", "yes\n"}) {
    const Answered answered = answer(check(), yes);
    EXPECT_TRUE(was_run()) << yes << answered.screen;
    EXPECT_EQ(answered.questions, 1) << answered.screen;
  }
  const std::string long_answer = std::string(200, 'n') + "y\n";
  for (const std::string& no :
       {std::string("n\n"), std::string("\n"), std::string("yellow\n"), long_answer}) {
    const Answered answered = answer(check(), no);
    EXPECT_FALSE(was_run()) << no << answered.screen;
    EXPECT_EQ(answered.status, 2);
    EXPECT_EQ(answered.questions, 1) << answered.screen;
    EXPECT_NE(answered.screen.find("is not loaded"), std::string::npos)
        << answered.screen;
    EXPECT_NE(answered.screen.find("--trust "), std::string::npos) << answered.screen;
  }
}

TEST_F(Question, AnEndOfFileIsNo) {
  write_library_scenario();
  const Answered answered = answer(check(), "\x04");
  EXPECT_FALSE(was_run()) << answered.screen;
  EXPECT_EQ(answered.status, 2) << answered.screen;
  EXPECT_NE(answered.screen.find("is not loaded"), std::string::npos) << answered.screen;
}

TEST_F(Question, ControlCEndsTheProgram) {
  write_library_scenario();
  const Answered answered = answer(check(), "\x03");
  EXPECT_FALSE(was_run()) << answered.screen;
  EXPECT_EQ(answered.status, -SIGINT) << answered.screen;
  const Answered half_typed = answer(check(), "y\x03");
  EXPECT_FALSE(was_run()) << half_typed.screen;
  EXPECT_EQ(half_typed.status, -SIGINT) << half_typed.screen;
}

// Of another question, perhaps.
TEST_F(Question, WhatWasTypedBeforeIsNoAnswer) {
  write_library_scenario();
  const Answered answered = answer(check(), "n\n", "y\ny\n");
  EXPECT_FALSE(was_run()) << answered.screen;
  EXPECT_EQ(answered.questions, 1) << answered.screen;
}

TEST_F(Question, OnlyYesStartsAProgram) {
  write("evil.yaml",
        "name: evil\nduration_s: 2\naircraft: [{name: mine, vehicle: {kind: mavlink, "
        "endpoint: 'udpin:0', physics: {kind: none, program: [/bin/sh, -c, 'touch " +
            marker().string() +
            "']}}, plant: {kind: fixed-wing, aircraft: bixler}, sensors: [fire]}]\n"
            "missions: []\n");
  const Words run = {"run", "evil.yaml", "--out", "out"};
  for (const char* no : {"n\n", "\x04", "\x03"}) {
    const Answered answered = answer(run, no);
    EXPECT_FALSE(was_run()) << answered.screen;
    EXPECT_NE(answered.screen.find("touch " + marker().string()), std::string::npos)
        << answered.screen;
    EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written";
  }
  const Answered answered = answer(run, "y\n");
  EXPECT_TRUE(was_run()) << answered.screen;
}

// All runs of a campaign name the same library.
TEST_F(Question, OfACampaignIsAskedOnce) {
  write_library_scenario();
  write("campaign.yaml",
        "name: evil\nscenario: evil.yaml\nseeds: 3\nfigures: [{figure: simulated_s}]\n");
  for (const bool yes : {true, false}) {
    const Answered answered =
        answer({"campaign", "campaign.yaml", "--out", "out"}, yes ? "y\n" : "n\n");
    EXPECT_EQ(was_run(), yes) << answered.screen;
    EXPECT_EQ(answered.questions, 1) << answered.screen;
  }
}

}  // namespace
}  // namespace skein::app
