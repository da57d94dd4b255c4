// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace skein::app {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The program as a user meets it, started in a scratch folder of its own.
class Program : public testing::Test {
 protected:
  struct Finished {
    int status = -1;  // exit status, or -signal
    std::string out, err;
  };

  Program() {
    std::string pattern = (fs::temp_directory_path() / "program-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Program() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  // Starts the program in the scratch folder; `file_limit` bounds the size of its files,
  // `memory_limit` its address space [bytes].
  pid_t start(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY,
              rlim_t memory_limit = RLIM_INFINITY, int out = -1) {
    std::string program = SKEIN_PROGRAM;
    std::vector<char*> argv{program.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0) _exit(99);
    if (!freopen((prefix_ + "out.txt").c_str(), "w", stdout) ||
        !freopen((prefix_ + "err.txt").c_str(), "w", stderr))
      _exit(99);
    if (out >= 0) dup2(out, STDOUT_FILENO);
    if (!input_.empty() && !freopen(input_.c_str(), "r", stdin)) _exit(99);
    const rlimit limit{file_limit, file_limit}, memory{memory_limit, memory_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
    setrlimit(RLIMIT_AS, &memory);
    execv(SKEIN_PROGRAM, argv.data());
    _exit(99);
  }

  Finished finish(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    Finished result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result.out = read_file(folder_ / (prefix_ + "out.txt"));
    result.err = read_file(folder_ / (prefix_ + "err.txt"));
    return result;
  }

  Finished run(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY,
               rlim_t memory_limit = RLIM_INFINITY) {
    return finish(start(std::move(arguments), file_limit, memory_limit));
  }

  // With standard output going to an open file.
  Finished run_into(int out, std::vector<std::string> arguments) {
    return finish(start(std::move(arguments), RLIM_INFINITY, RLIM_INFINITY, out));
  }

  // Waits for a file of a program that was started, not for ever.
  static bool appears(const fs::path& file) {
    for (int k = 0; k < 3000 && !fs::exists(file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return fs::exists(file);
  }

  // The one number that a query gives; NaN when it gives none.
  static double query(const fs::path& database, const std::string& sql) {
    sqlite3* db = nullptr;
    double value = std::numeric_limits<double>::quiet_NaN();
    if (sqlite3_open_v2(database.c_str(), &db, SQLITE_OPEN_READWRITE, nullptr) ==
        SQLITE_OK) {
      sqlite3_exec(
          db, sql.c_str(),
          [](void* to, int, char** values, char**) {
            if (values[0]) *static_cast<double*>(to) = std::atof(values[0]);
            return 0;
          },
          &value, nullptr);
    }
    sqlite3_close(db);
    return value;
  }

  // Of a shipped scenario's first seconds.
  std::string hash_of(const std::string& scenario, int seconds,
                      std::vector<std::string> more) {
    std::vector<std::string> arguments = {
        "run",    SKEIN_SOURCE_DIR "/scenarios/" + scenario + ".yaml",
        "--json", "--overwrite",
        "--out",  "run",
        "--set",  "duration_s=" + std::to_string(seconds)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    const auto summary = nlohmann::json::parse(finished.out, nullptr, false);
    return summary.is_discarded() ? "" : summary.value("content_hash", "");
  }

  // A sanitizer reserves more address space than a limit of memory would leave.
  static constexpr bool kMemoryCanBeLimited =
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
      false;
#else
      true;
#endif

  fs::path folder_;
  std::string prefix_;  // of the files that programs write to: several may run at once
  fs::path input_;  // what programs read from standard input; empty: what the test has
};

}  // namespace skein::app
