// SPDX-License-Identifier: Apache-2.0
#include "skein/base/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "skein/base/output_file.h"

namespace skein::input_file_test {
namespace {

namespace fs = std::filesystem;

class InputFile : public testing::Test {
 protected:
  InputFile() {
    std::string pattern = (fs::temp_directory_path() / "input-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~InputFile() override { fs::remove_all(folder_); }

  fs::path written(const std::string& text) const {
    EXPECT_TRUE(write_file(folder_ / "file", std::string_view(text)));
    return folder_ / "file";
  }

  fs::path folder_;
};

TEST_F(InputFile, IsReadAsItIs) {
  for (const std::string& text :
       {std::string(), std::string("a\r\n\0b\xFF", 6), std::string(200'000, 'x')})
    EXPECT_EQ(read_file(written(text)).value(), text);
  fs::create_symlink("file", folder_ / "link");
  EXPECT_EQ(read_file(folder_ / "link").value().size(), 200'000U);
  EXPECT_EQ(read_file("/dev/null").value(), "");
}

TEST_F(InputFile, MayBeAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(300'000, 'p');
  std::thread writer([&] { EXPECT_TRUE(write_file(pipe, std::string_view(text))); });
  EXPECT_EQ(read_file(pipe).value(), text);
  writer.join();
}

TEST_F(InputFile, OpenedAsAStreamMayBeAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { EXPECT_TRUE(write_file(pipe, std::string_view("a\nb\n"))); });
  auto in = open_input(pipe);
  writer.join();
  ASSERT_TRUE(in) << in.error().text();
  std::string line;
  std::getline(in.value(), line);
  std::getline(in.value(), line);
  EXPECT_EQ(line, "b");
}

// Nobody writes to it: a signal ends the wait.
TEST_F(InputFile, APipeWithoutAWriterIsLeftByASignal) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::signal(SIGUSR1, [](int) {});
  for (const bool stream : {false, true}) {
    std::atomic<bool> over = false;
    std::thread reader([&] {
      const auto error = stream ? open_input(pipe).error() : read_file(pipe).error();
      EXPECT_EQ(error.code, ErrorCode::kUnavailable);
      EXPECT_NE(error.text().find("until a signal came"), std::string::npos);
      over = true;
    });
    while (!over) {
      pthread_kill(reader.native_handle(), SIGUSR1);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    reader.join();
  }
  std::signal(SIGUSR1, SIG_DFL);
}

TEST_F(InputFile, ATextThatIsKeptTakesNoMoreThanItHas) {
  EXPECT_LT(read_file(written("12345")).value().capacity(), 64u);
}

TEST_F(InputFile, ThatIsAFolderIsRefused) {
  for (const Error& error : {read_file(folder_).error(), open_input(folder_).error()}) {
    EXPECT_EQ(error.code, ErrorCode::kBadInput);
    EXPECT_EQ(error.text(), folder_.string() + ": is a folder, not a file.");
  }
}

TEST_F(InputFile, ThatIsNotThereIsRefused) {
  const fs::path none = folder_ / "none";
  for (const Error& error : {read_file(none).error(), open_input(none).error(),
                             read_file(written("") / "below").error()})
    EXPECT_EQ(error.code, ErrorCode::kNotFound) << error.text();
}

TEST_F(InputFile, ThatCannotBeReadSaysWhy) {
  fs::create_symlink("circle", folder_ / "circle");
  for (const Error& error :
       {read_file(folder_ / "circle").error(), open_input(folder_ / "circle").error()}) {
    EXPECT_EQ(error.code, ErrorCode::kUnavailable);
    EXPECT_NE(error.text().find("cannot be read: "), std::string::npos) << error.text();
  }
}

TEST_F(InputFile, MayHaveSoManyBytesAndNoMore) {
  const fs::path file = written("12345");
  EXPECT_EQ(read_file(file, 5).value(), "12345");
  EXPECT_EQ(read_file(file, 4).error().message, "more than 4 bytes.");
  EXPECT_EQ(read_file("/dev/zero", 100).error().code, ErrorCode::kBadInput);
}

TEST_F(InputFile, IsReadPieceByPiece) {
  auto in = open_input(written("one\ntwo\n"));
  ASSERT_TRUE(in);
  std::string line;
  std::getline(in.value(), line);
  EXPECT_EQ(line, "one");
}

}  // namespace
}  // namespace skein::input_file_test
