// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/line_input.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>

namespace skein::hmi::line_input_test {
namespace {

TEST(LineInput, GivesLinesAsTheyCome) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const auto send = [&](const std::string& text) {
    ASSERT_EQ(write(pipe_ends[1], text.data(), text.size()),
              static_cast<ssize_t>(text.size()));
  };
  LineInput input(pipe_ends[0]);
  EXPECT_TRUE(input.take().empty());
  send("one\ntw");
  EXPECT_EQ(input.take(), std::vector<std::string>{"one"});
  send("o\n\nthree");
  EXPECT_EQ(input.take(), (std::vector<std::string>{"two", ""}));
  close(pipe_ends[1]);
  EXPECT_EQ(input.take(), std::vector<std::string>{"three"});
  EXPECT_TRUE(input.take().empty());
  close(pipe_ends[0]);
  EXPECT_TRUE(LineInput(-1).take().empty());
}

TEST(LineInput, DropsALineThatIsTooLong) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  LineInput input(pipe_ends[0]);
  std::vector<std::string> lines;
  const std::string piece(8192, 'x');
  for (std::size_t sent = 0; sent <= LineInput::kMaxBytes; sent += piece.size()) {
    ASSERT_EQ(write(pipe_ends[1], piece.data(), piece.size()), 8192);
    for (std::string& line : input.take()) lines.push_back(std::move(line));
  }
  ASSERT_EQ(write(pipe_ends[1], "\nok\n", 4), 4);
  for (std::string& line : input.take()) lines.push_back(std::move(line));
  EXPECT_EQ(lines, (std::vector<std::string>{"(too long)", "ok"}));
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

}  // namespace
}  // namespace skein::hmi::line_input_test
