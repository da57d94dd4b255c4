// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "skein/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace skein::record {

/// The largest number that a database of a run may hold, either sign.
inline constexpr double kMaxStored = 1e15;
/// The latest time that one may hold, either sign [s].
inline constexpr double kMaxStoredTime = 9.2e9;
/// The largest number of a row: ten thousand million aircraft seconds.
inline constexpr std::int64_t kMaxRow = 100'000'000'000;
/// The longest text or blob that one may hold [bytes].
inline constexpr int kMaxCellBytes = 64 << 20;

/// A prepared statement. Parameters are bound in order by bind(); SQLite's own errors are
/// kept until step() reports them.
class Statement {
 public:
  Statement() = default;
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}

  /// Binds all parameters anew.
  template <class... Values>
  Statement& bind(const Values&... values) {
    int column = 0;
    (put(++column, values), ...);
    return *this;
  }

  /// Runs a statement that returns no rows, and makes it ready for the next.
  /// @returns SQLite's code; 0 when all went well.
  int run();

  /// Goes to the next row; false at the end or on an error (see failed()).
  bool next();
  bool failed() const { return failed_; }

  /// A value of the row; what is null is 0 or empty. A value of another kind, or one that
  /// no run stores, is 0 or empty, too, and then problem() says so.
  double real(int column) const;                      ///< finite, up to kMaxStored
  std::int64_t integer(int column) const;             ///< a whole number
  std::string text(int column) const;                 ///< made valid, base/valid_text.h
  std::span<const std::byte> blob(int column) const;  ///< valid until the next step
  /// As integer(), within limits; `low` where it is not.
  std::int64_t whole(int column, std::int64_t low, std::int64_t high) const;
  /// Seconds that a Time can hold.
  double seconds(int column) const;
  bool is_null(int column) const;

  /// Says that a value of the row makes no sense. The first problem is kept.
  /// @param allowed  what would: "a number above 0".
  void refuse(int column, std::string_view allowed) const;
  /// Which value of the row that has been read makes no sense, and what is allowed:
  /// "column charge holds 'x': allowed is a number"; empty: none.
  const std::string& problem() const { return problem_; }

  /// Binds one parameter, counted from 1. Text and blobs must live until run().
  void put(int column, double value);  ///< NULL where it is not finite
  void put(int column, std::int64_t value);
  void put(int column, std::uint32_t value) { put(column, std::int64_t{value}); }
  void put(int column, int value) { put(column, std::int64_t{value}); }
  void put(int column, bool value) { put(column, std::int64_t{value}); }
  void put(int column, std::string_view value);
  void put(int column, const std::string& value) { put(column, std::string_view(value)); }
  void put(int column, const char* value) { put(column, std::string_view(value)); }
  void put(int column, std::span<const std::byte> value);
  void put(int column, std::nullptr_t);
  void put(int column, const std::optional<double>& value);

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  bool is_number(int column) const;
  std::string shown_value(int column) const;

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  bool failed_ = false;
  mutable std::string problem_;
};

/// Lets all reading of databases in this process end, as soon as it is true, with an
/// error kInterrupted. Null: never. Call before the first is opened.
void stop_reading_when(const std::atomic<bool>* stop);

/// One connection to a database file.
class Sqlite {
 public:
  /// To be read: nothing of the run is changed, but a log that a killed run has left is
  /// merged. A statement ends with an error when it takes far more work than a file of
  /// this size can need, and at stop_reading_when().
  enum class Mode { kCreate, kRead };

  /// Fails: kUnavailable or kNotFound when the file cannot be opened or made; kBadInput
  ///        when what is to be read is no regular file.
  static Result<Sqlite> open(const std::filesystem::path& file, Mode mode);
  /// A database that is gone with this. Fails: what SQLite says of the statements.
  static Result<Sqlite> in_memory(const std::string& statements);
  Sqlite(Sqlite&&) noexcept;
  Sqlite& operator=(Sqlite&&) noexcept;
  ~Sqlite();

  /// Runs statements that take and give nothing.
  Result<void> execute(const std::string& sql);
  Result<Statement> prepare(const std::string& sql);

  const std::filesystem::path& file() const { return file_; }

  /// SQLite's last complaint about this file, in words for the user.
  Error error() const;
  /// Whether a transaction is open.
  bool in_transaction() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  Sqlite();
  struct Work;  // of the present statement
  static int look(void* work);
  Result<void> limit_reading();

  std::filesystem::path file_;
  std::unique_ptr<Work> work_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace skein::record
