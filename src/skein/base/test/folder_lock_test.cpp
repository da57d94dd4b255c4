// SPDX-License-Identifier: Apache-2.0
#include "skein/base/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

namespace skein::folder_lock_test {
namespace {

namespace fs = std::filesystem;

class Folder : public testing::Test {
 protected:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "lock-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() override { fs::remove_all(path_); }
  fs::path path_;
};

TEST_F(Folder, HasOneWriterAtATime) {
  EXPECT_FALSE(FolderLock::holder(path_));
  std::optional<FolderLock> first = FolderLock::take(path_, "a run").value();
  const auto second = FolderLock::take(path_, "a run");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kBadInput);
  const std::string self = "a run (process " + std::to_string(::getpid()) + ")";
  EXPECT_NE(second.error().text().find(self), std::string::npos) << second.error().text();
  EXPECT_EQ(FolderLock::holder(path_), self);
  first.reset();
  EXPECT_FALSE(FolderLock::holder(path_)) << "the file alone means nothing";
  EXPECT_TRUE(FolderLock::take(path_, "a study"));
}

TEST_F(Folder, IsFreeAgainWhenItsWriterWasKilled) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto lock = FolderLock::take(path_, "a run");
    const char sign = lock ? '1' : '0';
    if (::write(ready[1], &sign, 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char sign = 0;
  ASSERT_EQ(::read(ready[0], &sign, 1), 1);
  EXPECT_EQ(sign, '1');
  EXPECT_FALSE(FolderLock::take(path_, "a run"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(FolderLock::take(path_, "a run"));
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(Folder, SaysWhyItCannotBeLocked) {
  EXPECT_FALSE(FolderLock::take(path_ / "none", "a run"));
  fs::create_symlink("/nowhere", path_ / FolderLock::kFileName);
  EXPECT_FALSE(FolderLock::take(path_, "a run")) << "no link is followed";
}

}  // namespace
}  // namespace skein::folder_lock_test
