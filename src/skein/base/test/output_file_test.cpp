// SPDX-License-Identifier: Apache-2.0
#include "skein/base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace skein::output_file_test {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class OutputFile : public testing::Test {
 protected:
  OutputFile() {
    std::string pattern = (fs::temp_directory_path() / "output-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~OutputFile() override { fs::remove_all(folder_); }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

TEST_F(OutputFile, ReplacesARegularFileAndKeepsItsPermissions) {
  const fs::path file = folder_ / std::string(250, 'n');  // names may have 255 bytes
  ASSERT_TRUE(write_file(file, std::string_view("one")));
  EXPECT_EQ(content(file), "one");
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  struct stat before {};
  ASSERT_EQ(::stat(file.c_str(), &before), 0);
  ASSERT_TRUE(write_file(file, std::string_view("two\0x", 5)));
  EXPECT_EQ(content(file), std::string("two\0x", 5));
  struct stat after {};
  ASSERT_EQ(::stat(file.c_str(), &after), 0);
  EXPECT_EQ(after.st_mode, before.st_mode);
  EXPECT_NE(after.st_ino, before.st_ino) << "readers of the old one keep it whole";
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFile, LeavesADeviceADevice) {
  const fs::path device = folder_ / "null";
  if (::mknod(device.c_str(), S_IFCHR | 0666, ::makedev(1, 3)) != 0)
    GTEST_SKIP() << "devices are made by root only";
  fs::create_symlink("null", folder_ / "link.html");
  for (const char* name : {"null", "link.html"}) {
    EXPECT_TRUE(check_writable(folder_ / name));
    EXPECT_EQ(output_place(folder_ / name).value(), OutputPlace::kThrough);
    const auto written = write_file(folder_ / name, std::string_view("text"));
    // Some file systems allow no devices: then it cannot be written, and stays all the
    // same.
    EXPECT_TRUE(written || written.error().code == ErrorCode::kUnavailable);
    EXPECT_TRUE(fs::is_character_file(device)) << name;
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.html")) << name;
    std::ofstream(folder_ / "made") << "text";
    static_cast<void>(move_into_place(folder_ / "made", folder_ / name));
    EXPECT_TRUE(fs::is_character_file(device)) << name;
  }
}

TEST_F(OutputFile, WritesIntoAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(check_writable(pipe)) << "without waiting for a reader";
  std::string read;
  std::thread reader([&] { read = content(pipe); });
  EXPECT_TRUE(write_file(pipe, std::string_view("through")));
  reader.join();
  EXPECT_EQ(read, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

// Signals this thread again and again until `done`: one alone could come before it waits.
void disturb(pthread_t thread, const std::atomic<bool>& done) {
  while (!done) {
    pthread_kill(thread, SIGUSR1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST_F(OutputFile, ASignalEndsTheWaitForAReader) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  // As a program does: a call that waits is begun again by the system.
  std::signal(SIGUSR1, [](int) {});
  std::atomic<bool> done{false};
  std::thread signals(disturb, pthread_self(), std::cref(done));
  const auto unread = write_file(pipe, std::string_view("text"));
  const auto stream = OutputStream::open(pipe);
  // One who reads nothing: the pipe gets full.
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  const auto full = write_file(pipe, std::string(1 << 20, 'x'));
  done = true;
  signals.join();
  std::signal(SIGUSR1, SIG_DFL);
  ::close(reader);
  for (const Error& error : {unread.error(), stream.error(), full.error()}) {
    EXPECT_EQ(error.code, ErrorCode::kInterrupted) << error.text();
    EXPECT_EQ(error.place, pipe.string());
  }
}

TEST_F(OutputFile, AppendsToWhatIsThere) {
  const fs::path file = folder_ / "journal";
  for (const char* text : {"one ", "two"}) {
    auto stream = OutputStream::append(file);
    ASSERT_TRUE(stream);
    stream.value().write(text);
    EXPECT_TRUE(stream.value().flush());
  }
  EXPECT_EQ(content(file), "one two");
  EXPECT_FALSE(OutputStream::append(folder_));
}

TEST_F(OutputFile, AProgramGetsADescriptorThatWaits) {
  const fs::path file = folder_ / "log", pipe = folder_ / "pipe";
  std::ofstream(file) << "of a run before";
  fs::create_symlink("log", folder_ / "link");
  const auto regular = open_for_program(folder_ / "link");
  ASSERT_TRUE(regular);
  EXPECT_EQ(content(file), "");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  ::close(regular.value());

  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto unread = open_for_program(pipe);
  ASSERT_FALSE(unread) << "it would wait for a reader";
  EXPECT_NE(unread.error().text().find("nobody reads"), std::string::npos);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  const auto read = open_for_program(pipe);
  ASSERT_TRUE(read);
  EXPECT_EQ(::fcntl(read.value(), F_GETFL) & O_NONBLOCK, 0);
  EXPECT_NE(::fcntl(read.value(), F_GETFD) & FD_CLOEXEC, 0);
  ::close(read.value());
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_FALSE(open_for_program(folder_ / "none" / "log"));
}

TEST_F(OutputFile, WritesWhatALinkNamesAndLeavesTheLink) {
  fs::create_directory(folder_ / "there");
  std::ofstream(folder_ / "there" / "file") << "old";
  fs::create_symlink("there/file", folder_ / "link");
  fs::create_symlink("link", folder_ / "second");
  fs::create_symlink("there/new", folder_ / "dangling");
  ASSERT_TRUE(write_file(folder_ / "second", std::string_view("new")));
  ASSERT_TRUE(write_file(folder_ / "dangling", std::string_view("made")));
  EXPECT_TRUE(fs::is_symlink(folder_ / "second"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(content(folder_ / "there" / "file"), "new");
  EXPECT_EQ(content(folder_ / "there" / "new"), "made");
  fs::create_symlink("circle", folder_ / "circle");
  const auto circle = write_file(folder_ / "circle", std::string_view("x"));
  ASSERT_FALSE(circle);
  EXPECT_NE(circle.error().text().find("circle"), std::string::npos);
}

TEST_F(OutputFile, AnOpenDescriptorGoesOnWhereItIs) {
  const fs::path file = folder_ / "log";
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  ASSERT_EQ(::write(fd, "before ", 7), 7);
  const std::string number = std::to_string(fd);
  EXPECT_TRUE(check_writable("/proc/self/fd/" + number));
  EXPECT_TRUE(write_file("/proc/self/fd/" + number, std::string_view("first ")));
  EXPECT_TRUE(write_file("/dev/fd/" + number, std::string_view("second ")));
  fs::create_symlink("/proc/self/fd/" + number, folder_ / "link");
  EXPECT_TRUE(write_file(folder_ / "link", std::string_view("third")));
  EXPECT_EQ(::write(fd, ".", 1), 1) << "it is still open";
  ::close(fd);
  EXPECT_EQ(content(file), "before first second third.");
  EXPECT_FALSE(write_file("/proc/self/fd/" + number, std::string_view("closed")));
}

TEST_F(OutputFile, WhatCannotBeWrittenIsNamed) {
  for (const fs::path& file : {folder_, folder_ / "none" / "x", fs::path("/dev/full")}) {
    if (file == "/dev/full" && !fs::is_character_file(file)) continue;
    const auto written = write_file(file, std::string_view("text"));
    ASSERT_FALSE(written) << file;
    EXPECT_EQ(written.error().code, ErrorCode::kUnavailable);
    EXPECT_EQ(written.error().place, file.string());
  }
  EXPECT_FALSE(check_writable(folder_ / "none" / "x"));
  EXPECT_EQ(files(), 0U);
}

TEST_F(OutputFile, AFinishedFileMovesToItsPlace) {
  std::ofstream(folder_ / "made") << "content";
  std::ofstream(folder_ / "target") << "old";
  ASSERT_EQ(::chmod((folder_ / "target").c_str(), 0604), 0);
  fs::create_symlink("target", folder_ / "link");
  ASSERT_TRUE(move_into_place(folder_ / "made", folder_ / "link"));
  EXPECT_EQ(content(folder_ / "target"), "content");
  struct stat state {};
  ASSERT_EQ(::stat((folder_ / "target").c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 0777U, 0604U);
  EXPECT_FALSE(fs::exists(folder_ / "made"));
  EXPECT_FALSE(move_into_place(folder_ / "made", folder_ / "link"));
}

}  // namespace
}  // namespace skein::output_file_test
