// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/token_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "skein/base/valid_text.h"

namespace skein::hmi::token_file_test {
namespace {

class TokenFile : public testing::Test {
 protected:
  void SetUp() override { write("0123456789abcdef operator Anna\n", 0600); }
  void TearDown() override { std::filesystem::remove(file_); }
  void write(const std::string& text, mode_t mode) {
    std::ofstream(file_, std::ios::binary) << text;
    ASSERT_EQ(::chmod(file_.c_str(), mode), 0);
  }

  const std::string file_ = (std::filesystem::temp_directory_path() /
                             ("skein-tokens-" + std::to_string(::getpid())))
                                .string();
};

TEST_F(TokenFile, OfTheOwnerAloneIsRead) {
  for (const mode_t mode : {0600, 0400, 0700}) {
    ASSERT_EQ(::chmod(file_.c_str(), mode), 0);
    const auto table = read_token_file(file_);
    ASSERT_TRUE(table) << table.error().text();
    EXPECT_EQ(table.value().find("0123456789abcdef")->name, "Anna");
  }
}

TEST_F(TokenFile, ThatOthersCanReadOrChangeIsRefusedWithWhatToDo) {
  for (const mode_t mode : {0644, 0640, 0604, 0660, 0620, 0602, 0777, 0610}) {
    ASSERT_EQ(::chmod(file_.c_str(), mode), 0);
    const auto table = read_token_file(file_);
    ASSERT_FALSE(table) << mode;
    EXPECT_NE(table.error().text().find("chmod 600 " + file_), std::string::npos)
        << table.error().text();
  }
}

TEST_F(TokenFile, ThatIsNoneOrTooLargeIsRefused) {
  EXPECT_EQ(read_token_file("/nowhere/tokens").error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(read_token_file(std::filesystem::temp_directory_path().string()));
  write(std::string(2 << 20, '#'), 0600);
  EXPECT_FALSE(read_token_file(file_));
}

TEST_F(TokenFile, NamesInItAreText) {
  write("0123456789abcdef operator An\xff\xfe\n", 0600);
  const auto table = read_token_file(file_);
  ASSERT_TRUE(table);
  EXPECT_EQ(table.value().find("0123456789abcdef")->name, "An\uFFFD\uFFFD");
}

}  // namespace
}  // namespace skein::hmi::token_file_test
