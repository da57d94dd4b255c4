#include "skein/record/sqlite.h"

#include <sqlite3.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "skein/base/valid_text.h"

namespace skein::record {

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

int Statement::run() {
  sqlite3_step(statement_.get());
  return sqlite3_reset(statement_.get());  // repeats the code of a failed step
}

bool Statement::next() {
  const int code = sqlite3_step(statement_.get());
  failed_ = code != SQLITE_ROW && code != SQLITE_DONE;
  return code == SQLITE_ROW;
}

double Statement::real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const std::span<const std::byte> bytes = blob(column);
  return valid_text(
      std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::span<const std::byte> Statement::blob(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const std::byte*>(bytes), static_cast<std::size_t>(size)};
}

void Statement::put(int column, double value) {
  sqlite3_bind_double(statement_.get(), column, value);
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
  if (attempt(file.string(), SQLITE_OPEN_READWRITE)) return result;
  const Error first = result.error();
  if (attempt(file.string(), SQLITE_OPEN_READONLY)) return result;
  std::string uri = "file:";
  for (const char c : file.string())
    uri += c == '%' ? "%25" : c == '?' ? "%3f" : c == '#' ? "%23" : std::string(1, c);
  if (attempt(uri + "?immutable=1", SQLITE_OPEN_READONLY | SQLITE_OPEN_URI))
    return result;
  return first;
}

Result<void> Sqlite::execute(const std::string& sql) {
  if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    return error();
  return {};
}

Result<Statement> Sqlite::prepare(const std::string& sql) {
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
  std::string message = sqlite3_errmsg(database_.get());
  if (system != 0) message += std::string(": ") + std::strerror(system);
  const bool content = code == SQLITE_CORRUPT || code == SQLITE_NOTADB;
  return Error{content ? ErrorCode::kBadInput : ErrorCode::kUnavailable, file_.string(),
               message, ""};
}

bool Sqlite::in_transaction() const {
  return sqlite3_get_autocommit(database_.get()) == 0;
}

}  // namespace skein::record
