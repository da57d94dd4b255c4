#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/id.h"
#include "skein/record/sqlite.h"

namespace skein::record {

/// The row that an INSERT statement is given, for columns::put().
class RowSink {
 public:
  explicit RowSink(Statement& statement) : statement_(statement) {}

  template <class Value>
  void put(const Value& value) {
    statement_.put(++column_, value);
  }
  void put(std::string&& text) {
    statement_.put(++column_, std::string_view(texts_.emplace_back(std::move(text))));
  }
  void put(std::vector<float>&& numbers) {
    floats_.push_back(std::move(numbers));
    statement_.put(++column_, std::as_bytes(std::span(floats_.back())));
  }
  void put(std::vector<std::byte>&& bytes) {
    bytes_.push_back(std::move(bytes));
    statement_.put(++column_, std::span<const std::byte>(bytes_.back()));
  }

 private:
  Statement& statement_;
  int column_ = 0;
  // What was made for this row; a deque moves nothing.
  std::deque<std::string> texts_;
  std::deque<std::vector<float>> floats_;
  std::deque<std::vector<std::byte>> bytes_;
};

/// The numbers of a blob of 32-bit floats.
inline std::vector<float> float_blob(const Statement& row, int column) {
  const std::span<const std::byte> bytes = row.blob(column);
  std::vector<float> floats(bytes.size() / sizeof(float));
  if (!floats.empty())
    std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
  return floats;
}

inline EntityId entity_id(const Statement& row, int column) {
  return EntityId{static_cast<std::uint32_t>(row.integer(column))};
}

/// The row that a SELECT statement has reached, for columns::take().
class RowSource {
 public:
  explicit RowSource(const Statement& row) : row_(row) {}

  bool take(double& value) {
    if (row_.is_null(column_)) return skip();
    value = row_.real(column_++);
    return true;
  }
  bool take(std::int64_t& value) {
    if (row_.is_null(column_)) return skip();
    value = row_.integer(column_++);
    return true;
  }
  bool take(std::string& value) {
    if (row_.is_null(column_)) return skip();
    value = row_.text(column_++);
    return true;
  }
  bool take(std::vector<std::byte>& value) {
    if (row_.is_null(column_)) return skip();
    const auto bytes = row_.blob(column_++);
    value.assign(bytes.begin(), bytes.end());
    return true;
  }
  bool skip() {
    ++column_;
    return false;
  }
  void check(bool good) { good_ = good_ && good; }
  /// Whether all values made sense.
  bool good() const { return good_; }

 private:
  const Statement& row_;
  int column_ = 0;
  bool good_ = true;
};

}  // namespace skein::record
