#pragma once

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
  double real(int column) const;
  std::int64_t integer(int column) const;
  /// Whatever bytes the file holds there, as valid_text() has them.
  std::string text(int column) const;
  bool is_null(int column) const;
  /// Valid until the next step.
  std::span<const std::byte> blob(int column) const;

  /// Binds one parameter, counted from 1. Text and blobs must live until run().
  void put(int column, double value);  ///< NaN is stored as NULL
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
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  bool failed_ = false;
};

/// One connection to a database file.
class Sqlite {
 public:
  enum class Mode { kCreate, kRead };

  /// Fails: kUnavailable or kNotFound when the file cannot be opened or made.
  static Result<Sqlite> open(const std::filesystem::path& file, Mode mode);

  /// Runs statements that take and give nothing.
  Result<void> execute(const std::string& sql);
  Result<Statement> prepare(const std::string& sql);

  /// SQLite's last complaint about this file, in words for the user.
  Error error() const;
  /// Whether a transaction is open.
  bool in_transaction() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace skein::record
