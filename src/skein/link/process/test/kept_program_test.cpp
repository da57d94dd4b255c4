// SPDX-License-Identifier: Apache-2.0
#include "skein/link/process/kept_program.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace skein::process::kept_program_test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class KeptProgramTest : public testing::Test {
 protected:
  ~KeptProgramTest() override { fs::remove_all(folder_); }

  Program script(const std::string& text) const {
    return {{"sh", "-c", text}, folder_ / "work", folder_ / "logs" / "log.txt", {}};
  }
  // The next change; waits for it.
  static std::optional<KeptProgram::Change> next(KeptProgram& kept,
                                                 KeptProgram::Clock::duration later) {
    for (int k = 0; k < 500; ++k) {
      if (auto change = kept.look(KeptProgram::Clock::now() + later)) return change;
      std::this_thread::sleep_for(10ms);
    }
    return std::nullopt;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("skein-kept-" + std::to_string(::getpid()));
};

TEST_F(KeptProgramTest, MakesItsFoldersAndSaysHowItEnded) {
  KeptProgram kept(script("echo all is lost; exit 3"), false);
  ASSERT_TRUE(kept.start());
  const auto change = next(kept, 0s);
  ASSERT_TRUE(change);
  EXPECT_FALSE(change->started);
  EXPECT_NE(change->text.find("ended with 3"), std::string::npos) << change->text;
  EXPECT_NE(change->text.find("all is lost"), std::string::npos) << change->text;
  EXPECT_FALSE(kept.runs(KeptProgram::Clock::now()));
  EXPECT_FALSE(kept.look(KeptProgram::Clock::now() + 1h)) << "once";
}

TEST_F(KeptProgramTest, StartsAgainAfterASecondButNotForEver) {
  KeptProgram kept(script("exit 1"), true);
  ASSERT_TRUE(kept.start());
  ASSERT_TRUE(next(kept, 0s));
  EXPECT_FALSE(kept.look(KeptProgram::Clock::now())) << "not at once";
  auto later = 0s;
  int starts = 0;
  for (; starts < 50; ++starts) {
    later += 5s;
    const auto again = kept.look(KeptProgram::Clock::now() + later);
    if (!again) break;
    EXPECT_TRUE(again->started);
    const auto ended = next(kept, later);
    ASSERT_TRUE(ended);
    EXPECT_FALSE(ended->started);
  }
  EXPECT_EQ(starts, 10);
}

TEST_F(KeptProgramTest, WhatIsNotThereFails) {
  Program program = script("");
  program.arguments = {"/no/such/program"};
  EXPECT_FALSE(KeptProgram(program, true).start());
}

}  // namespace
}  // namespace skein::process::kept_program_test
