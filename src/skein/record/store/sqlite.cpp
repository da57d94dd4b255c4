// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/sqlite.h"

#include <sqlite3.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "skein/base/shown_text.h"
#include "skein/base/valid_text.h"

namespace skein::record {
namespace {

const std::atomic<bool>* stop_requested = nullptr;

constexpr int kLookEach = 1000;  // steps of SQLite's machine
// Steps of one statement. Measured: a row takes 10 to 30 of them, and more than 10 bytes.
constexpr double kStepsAtLeast = 1e8;
constexpr double kStepsPerByte = 100;

std::uintmax_t size_of(const std::filesystem::path& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  return none ? 0 : size;
}

}  // namespace

void stop_reading_when(const std::atomic<bool>* stop) {
  stop_requested = stop;
}

struct Sqlite::Work {
  double steps = 0, allowed = 0;
  bool exceeded = false;
};

Sqlite::Sqlite() = default;
Sqlite::Sqlite(Sqlite&&) noexcept = default;
Sqlite& Sqlite::operator=(Sqlite&&) noexcept = default;
Sqlite::~Sqlite() = default;

int Sqlite::look(void* work) {
  auto& now = *static_cast<Work*>(work);
  now.steps += kLookEach;
  now.exceeded = now.exceeded || now.steps > now.allowed;
  return now.exceeded || (stop_requested && *stop_requested) ? 1 : 0;
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

int Statement::run() {
  sqlite3_step(statement_.get());
  return sqlite3_reset(statement_.get());  // repeats the code of a failed step
}

bool Statement::next() {
  problem_.clear();
  const int code = sqlite3_step(statement_.get());
  failed_ = code != SQLITE_ROW && code != SQLITE_DONE;
  return code == SQLITE_ROW;
}

bool Statement::is_number(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  return type == SQLITE_FLOAT || type == SQLITE_INTEGER;
}

double Statement::real(int column) const {
  if (is_null(column)) return 0;
  const double value =
      is_number(column) ? sqlite3_column_double(statement_.get(), column) : NAN;
  if (std::abs(value) <= kMaxStored) return value;
  refuse(column, "a number from -1e15 to 1e15");
  return 0;
}

double Statement::seconds(int column) const {
  const double value = real(column);
  if (std::abs(value) <= kMaxStoredTime) return value;
  refuse(column, "a time from -9.2e9 to 9.2e9 s");
  return 0;
}

std::int64_t Statement::integer(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  if (type == SQLITE_INTEGER) return sqlite3_column_int64(statement_.get(), column);
  if (type != SQLITE_NULL) refuse(column, "a whole number");
  return 0;
}

std::int64_t Statement::whole(int column, std::int64_t low, std::int64_t high) const {
  const std::int64_t value = integer(column);
  if (value >= low && value <= high) return value;
  refuse(column,
         "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return low;
}

std::string Statement::text(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  if (type == SQLITE_NULL) return {};
  if (type == SQLITE_BLOB) {
    refuse(column, "text");
    return {};
  }
  const auto* bytes =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int size = sqlite3_column_bytes(statement_.get(), column);
  // Versions before this one stored what vehicles said byte by byte.
  return valid_text(
      std::string(bytes ? bytes : "", bytes ? static_cast<std::size_t>(size) : 0));
}

std::string Statement::shown_value(int column) const {
  constexpr std::size_t kLongest = 40;
  const int type = sqlite3_column_type(statement_.get(), column);
  if (type == SQLITE_BLOB)
    return "a blob of " + std::to_string(sqlite3_column_bytes(statement_.get(), column)) +
           " bytes";
  const auto* bytes =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  std::string text = bytes ? bytes : "nothing";
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return type == SQLITE_TEXT ? "the text \"" + shown(text) + "\"" : text;
}

void Statement::refuse(int column, std::string_view allowed) const {
  if (!problem_.empty()) return;
  const char* name = sqlite3_column_name(statement_.get(), column);
  problem_ = std::string("column ") + (name ? name : "?") + ": " + shown_value(column) +
             " makes no sense; allowed: " + std::string(allowed) + ".";
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::span<const std::byte> Statement::blob(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  if (type != SQLITE_BLOB) {
    if (type != SQLITE_NULL) refuse(column, "a blob");
    return {};
  }
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)};
}

// A number that is none, or infinite, does not exist: no table holds one.
void Statement::put(int column, double value) {
  if (std::isfinite(value))
    sqlite3_bind_double(statement_.get(), column, value);
  else
    put(column, nullptr);
}

void Statement::put(int column, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), column, value);
}

// Text and blobs outlive run(): SQLite need not copy them.
void Statement::put(int column, std::string_view value) {
  sqlite3_bind_text64(statement_.get(), column, value.data(), value.size(), nullptr,
                      SQLITE_UTF8);
}

void Statement::put(int column, std::span<const std::byte> value) {
  sqlite3_bind_blob64(statement_.get(), column, value.data(), value.size(), nullptr);
}

void Statement::put(int column, std::nullptr_t) {
  sqlite3_bind_null(statement_.get(), column);
}

void Statement::put(int column, const std::optional<double>& value) {
  if (value)
    put(column, *value);
  else
    put(column, nullptr);
}

void Sqlite::Close::operator()(sqlite3* database) const {
  sqlite3_close_v2(database);  // waits for the statements that still use it
}

Result<Sqlite> Sqlite::open(const std::filesystem::path& file, Mode mode) {
  std::error_code ignored;
  if (mode == Mode::kRead && !std::filesystem::exists(file, ignored))
    return Error{ErrorCode::kNotFound, file.string(), "there is no such database",
                 "give the directory of a run"};
  if (mode == Mode::kRead && !std::filesystem::is_regular_file(file, ignored))
    return Error{ErrorCode::kBadInput, file.string(), "is no regular file",
                 "give the directory of a run"};
  Sqlite result;
  result.file_ = file;
  const auto attempt = [&result](const std::string& name, int flags) {
    sqlite3* database = nullptr;
    sqlite3_open_v2(name.c_str(), &database, flags | SQLITE_OPEN_NOMUTEX, nullptr);
    result.database_.reset(database);
    // The file is looked at only when it is first asked something.
    return sqlite3_exec(database, "SELECT count(*) FROM sqlite_master", nullptr, nullptr,
                        nullptr) == SQLITE_OK;
  };
  if (mode == Mode::kCreate) {
    if (attempt(file.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE)) return result;
    return result.error();
  }
  // A killed run leaves a log that only a writer may merge; a copy on a read-only medium
  // can be read as it is.
  const auto opened = [&result]() -> Result<Sqlite> {
    if (auto done = result.limit_reading(); !done) return done.error();
    return std::move(result);
  };
  if (attempt(file.string(), SQLITE_OPEN_READWRITE)) return opened();
  const Error first = result.error();
  if (attempt(file.string(), SQLITE_OPEN_READONLY)) return opened();
  if (size_of(file.string() + "-wal") > 0)
    return Error{ErrorCode::kUnavailable, file.string(),
                 "the run was cut off, and its last rows are in a log beside it that can "
                 "only be read where files can be written",
                 "copy the folder and give the copy"};
  std::string uri = "file:";
  for (const char c : file.string())
    uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
  if (attempt(uri + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI))
    return opened();
  return first;
}

Result<Sqlite> Sqlite::in_memory(const std::string& statements) {
  Sqlite result;
  result.file_ = ":memory:";
  sqlite3* database = nullptr;
  const int code = sqlite3_open_v2(
      ":memory:", &database,
      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  result.database_.reset(database);
  if (code != SQLITE_OK) return result.error();
  if (auto done = result.execute(statements); !done) return done.error();
  return result;
}

// What a stored run may make this process do.
Result<void> Sqlite::limit_reading() {
  const double bytes =
      static_cast<double>(size_of(file_) + size_of(file_.string() + "-wal"));
  work_ = std::make_unique<Work>();
  work_->allowed = kStepsAtLeast + kStepsPerByte * bytes;
  sqlite3_progress_handler(database_.get(), kLookEach, &Sqlite::look, work_.get());
  // No cell is longer than the file.
  const int longest =
      static_cast<int>(std::min<double>(kMaxCellBytes, std::max<double>(1 << 20, bytes)));
  sqlite3_limit(database_.get(), SQLITE_LIMIT_LENGTH, longest);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  // A run that replaces this one has a log of the same name: it is not this reader's.
  int keep = 1;
  sqlite3_file_control(database_.get(), "main", SQLITE_FCNTL_PERSIST_WAL, &keep);
  return execute("PRAGMA cell_size_check=ON");
}

Result<void> Sqlite::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return error();
  return {};
}

Result<Statement> Sqlite::prepare(const std::string& sql) {
  if (work_) work_->steps = 0;
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) !=
      SQLITE_OK)
    return error();
  return Statement(statement);
}

Error Sqlite::error() const {
  const int code = sqlite3_extended_errcode(database_.get());
  const int system = sqlite3_system_errno(database_.get());
  const bool full = (code & 0xff) == SQLITE_FULL || system == ENOSPC || system == EFBIG ||
                    system == EDQUOT;
  if (full)
    return Error{ErrorCode::kUnavailable, file_.string(),
                 "the disk is full, or the file has reached its largest size",
                 "make room; what was written before is kept"};
  if (code == SQLITE_INTERRUPT && work_ && work_->exceeded)
    return Error{ErrorCode::kBadInput, file_.string(),
                 "takes far more work to read than a run of its size: it is damaged, or "
                 "no run",
                 ""};
  if (code == SQLITE_INTERRUPT)
    return Error{ErrorCode::kInterrupted, file_.string(), "reading was interrupted", ""};
  std::string message = sqlite3_errmsg(database_.get());
  if (system != 0) message += std::string(": ") + std::strerror(system);
  const int kind = code & 0xff;
  const bool content = kind == SQLITE_CORRUPT || kind == SQLITE_NOTADB ||
                       kind == SQLITE_TOOBIG || kind == SQLITE_ERROR;
  return Error{content ? ErrorCode::kBadInput : ErrorCode::kUnavailable, file_.string(),
               message, ""};
}

bool Sqlite::in_transaction() const {
  return sqlite3_get_autocommit(database_.get()) == 0;
}

}  // namespace skein::record
