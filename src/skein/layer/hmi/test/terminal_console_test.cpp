// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/terminal_console.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>

namespace skein::hmi::terminal_console_test {
namespace {

RunProgress half_way() {
  return {Time::from_seconds(1800), Time::from_seconds(3600), 512.4, "RMSE 9.6 m"};
}

class File {
 public:
  File() : file_(std::tmpfile()) {}
  ~File() { std::fclose(file_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  std::FILE* get() { return file_; }
  std::string text() {
    std::rewind(file_);
    std::array<char, 4096> buffer{};
    const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file_);
    return {buffer.data(), n};
  }

 private:
  std::FILE* file_;
};

TEST(ProgressLine, SaysHowFarTheRunIs) {
  EXPECT_EQ(
      progress_line(half_way(), 200),
      "[##########..........]  50 %  0:30:00 / 1:00:00  512x  0:00:04 left  RMSE 9.6 m");
}

TEST(ProgressLine, EndsWell) {
  const RunProgress end{Time::from_seconds(60), Time::from_seconds(60), 1.25, ""};
  EXPECT_EQ(progress_line(end, 200),
            "[####################] 100 %  0:01:00 / 0:01:00  1.2x");
  const RunProgress nothing{Time(), Time(), 0, ""};
  EXPECT_EQ(progress_line(nothing, 200),
            "[####################] 100 %  0:00:00 / 0:00:00  0.0x");
}

TEST(ProgressLine, FitsTheTerminalInCharactersNotBytes) {
  RunProgress progress = half_way();
  progress.headline = "\u00b1\u00b1\u00b1\u00b1\u00b1\u00b1";
  const std::string full = progress_line(progress, 200);
  const std::string cut = progress_line(progress, 75);
  EXPECT_EQ(full.substr(0, cut.size()), cut);
  int characters = 0;
  for (const char c : cut) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  EXPECT_EQ(characters, 75);
}

TEST(TerminalConsole, RedrawsOneLineInPlace) {
  std::atomic<bool> stop = false;
  File file;
  {
    TerminalConsole console(stop, file.get(), true, 120);
    RunProgress progress = half_way();
    console.show(progress);
    console.show(progress);  // nothing new
    progress.now = Time::from_seconds(3600);
    console.show(progress);
  }
  const std::string text = file.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 2);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
}

TEST(TerminalConsole, AlertsStayAboveTheProgress) {
  std::atomic<bool> stop = false;
  File file;
  {
    TerminalConsole console(stop, file.get(), true, 120);
    console.show(half_way());
    console.announce({Time::from_seconds(1801), EntityId{1}, EventKind::kTrafficAlert,
                      "traffic, 2 o'clock, 1.2 km, 40 m above, turn right 080"},
                     "uav-2");
    console.show(half_way());
    console.announce({Time::from_seconds(1805), EntityId{1}, EventKind::kRecommended,
                      "gives\x1b[2J way"},
                     "uav-2");
  }
  const std::string text = file.text();
  EXPECT_NE(text.find("\r\x1b[K0:30:01 uav-2: traffic, 2 o'clock, 1.2 km, 40 m above, "
                      "turn right 080\n\r["),
            std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with("0:30:05 uav-2: recommended path: gives\\x1b[2J way\n"))
      << text;
}

TEST(TerminalConsole, IsSilentWithoutATerminal) {
  std::atomic<bool> stop = false;
  File file;
  {
    TerminalConsole console(stop, file.get());
    console.show(half_way());
  }
  EXPECT_EQ(file.text(), "");
}

TEST(TerminalConsole, PassesOnTheRequestToStop) {
  std::atomic<bool> stop = false;
  const TerminalConsole console(stop);
  EXPECT_FALSE(console.stop_requested());
  stop = true;
  EXPECT_TRUE(console.stop_requested());
}

TEST(TerminalConsole, TakesCommandsAndSaysWhatIsWrongWithThem) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const std::string text = "zone on a circle 0,0 50\n\nzone in a\nzone off a\n";
  ASSERT_EQ(write(pipe_ends[1], text.data(), text.size()),
            static_cast<ssize_t>(text.size()));
  File file;
  const std::atomic<bool> stop = false;
  TerminalConsole console(stop, file.get(), false, 80, pipe_ends[0]);
  const std::vector<CommandRecord> given = console.commands();
  ASSERT_EQ(given.size(), 2u);
  EXPECT_EQ(given[0].sender, "terminal");
  EXPECT_TRUE(std::get<ZoneChange>(given[0].command).on);
  EXPECT_FALSE(std::get<ZoneChange>(given[1].command).on);
  EXPECT_NE(file.text().find("this is no command"), std::string::npos);
  EXPECT_TRUE(console.commands().empty());
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

}  // namespace
}  // namespace skein::hmi::terminal_console_test
