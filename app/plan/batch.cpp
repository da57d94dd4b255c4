// SPDX-License-Identifier: Apache-2.0
// skein plan connect --batch: a table of connections, answered row by row.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/plan/arguments.h"
#include "skein/base/output_file.h"
#include "skein/exchange/plan/connection_batch.h"

namespace skein::app {
namespace {

constexpr std::size_t kPart = 1 << 18;  // bytes read at a time

// An open file, or standard input, which is never closed.
class Input {
 public:
  Result<void> open_file(const std::string& name) {
    name_ = name == "-" ? "standard input" : name;
    if (name == "-") return {};
    // A pipe without a writer yet is waited for in next(), where a signal is seen.
    descriptor_ = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0)
      return Error{ErrorCode::kNotFound, name,
                   fmt::format("cannot be read: {}.", std::strerror(errno)), ""};
    return {};
  }
  Input() = default;
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input() {
    if (descriptor_ != STDIN_FILENO && descriptor_ >= 0) ::close(descriptor_);
  }

  // Bytes that are there; none (an empty text) at the end, nothing when none came for a
  // while or a signal did.
  Result<std::optional<std::string_view>> next(std::string& buffer) const {
    constexpr int kPatience = 200;  // [ms]
    pollfd ready{descriptor_, POLLIN, 0};
    if (::poll(&ready, 1, kPatience) <= 0) return std::optional<std::string_view>();
    buffer.resize(kPart);
    const ssize_t got = ::read(descriptor_, buffer.data(), buffer.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN))
      return std::optional<std::string_view>();
    if (got < 0)
      return Error{ErrorCode::kUnavailable, name_,
                   fmt::format("cannot be read: {}.", std::strerror(errno)), ""};
    return std::optional(std::string_view(buffer.data(), static_cast<std::size_t>(got)));
  }
  const std::string& name() const { return name_; }

 private:
  int descriptor_ = STDIN_FILENO;
  std::string name_;
};

// Where answers go.
class Output {
 public:
  Result<void> open_file(const std::string& name) {
    name_ = name;
    if (name == "-") return {};
    auto opened = OutputStream::open(name);
    if (!opened) return opened.error();
    file_ = std::move(opened).value();
    return {};
  }
  // Answers leave as soon as they are there: in a pipe somebody waits for them.
  Result<bool> put(std::string_view text) {
    if (name_ == "-") return put_out_now(text);
    file_.write(text);
    if (auto good = file_.flush(); !good) return good.error();
    return true;
  }
  Result<void> close() { return file_.flush(); }

 private:
  std::string name_ = "-";
  OutputStream file_;
};

// Answers all rows; false when it was stopped or nobody reads the answers any more.
Result<bool> answer_all(const Input& input, exchange::ConnectionBatch& batch,
                        Output& output, const std::atomic<bool>& stop) {
  std::string buffer, answers;
  while (!stop) {
    const auto part = input.next(buffer);
    if (!part) return part.error();
    if (!part.value()) continue;
    answers.clear();
    const bool at_end = part.value()->empty();
    const Result<void> taken =
        at_end ? batch.finish(answers) : batch.take(*part.value(), answers);
    const Result<bool> put = output.put(answers);
    if (!taken) return taken.error();
    if (!put) return put.error();
    if (at_end) return true;
    if (!put.value()) return false;
  }
  return false;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return a != "-" && b != "-" && std::filesystem::equivalent(a, b, none);
}

}  // namespace

int plan_batch_command(const PlanConnectArguments& arguments,
                       const std::atomic<bool>& stop) {
  if (same_file(arguments.batch, arguments.batch_output)) {
    complain("error: {}: is the input as well as the output.\n", arguments.batch);
    return kBadUsage;
  }
  if (arguments.batch != "-" && std::filesystem::is_directory(arguments.batch)) {
    complain("error: {}: is a folder, not a table.\n", arguments.batch);
    return kBadUsage;
  }
  Input input;
  if (auto good = input.open_file(arguments.batch); !good) return say_error(good.error());
  Output output;
  if (auto good = output.open_file(arguments.batch_output); !good)
    return say_error(good.error());
  exchange::ConnectionBatch batch(input.name());
  const Result<bool> done = answer_all(input, batch, output, stop);
  const Result<void> closed = output.close();
  if (!done) return say_error(done.error());
  if (!closed) return say_error(closed.error());
  if (stop) return kInterrupted;
  if (!done.value()) return kDone;  // whether the answers are lost is said at the end
  if (batch.unsolved() > 0)
    complain("note: {} of {} rows have no connection; the column status says why.\n",
             batch.unsolved(), batch.rows());
  return kDone;
}

}  // namespace skein::app
