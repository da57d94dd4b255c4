// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/record/store/sqlite.h"

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
/// @param each  numbers of an item, of which there are whole ones.
inline std::vector<float> float_blob(const Statement& row, int column,
                                     std::size_t each = 1) {
  const std::span<const std::byte> bytes = row.blob(column);
  if (bytes.size() % (each * sizeof(float)) != 0) {
    row.refuse(column,
               "a multiple of " + std::to_string(each * sizeof(float)) + " bytes");
    return {};
  }
  std::vector<float> floats(bytes.size() / sizeof(float));
  if (!floats.empty())
    std::memcpy(floats.data(), bytes.data(), floats.size() * sizeof(float));
  return floats;
}

/// The points of a stored ring, of which the first two numbers are north and east [m]:
/// not on another planet.
inline std::vector<float> stored_ring(const Statement& row, int column,
                                      std::size_t each) {
  constexpr float kMaxPlace = 1e8F;
  std::vector<float> floats = float_blob(row, column, each);
  for (std::size_t k = 0; k + each <= floats.size(); k += each)
    if (!(std::abs(floats[k]) <= kMaxPlace && std::abs(floats[k + 1]) <= kMaxPlace))
      row.refuse(column, "places within 1e8 m");
  return floats;
}

inline EntityId entity_id(const Statement& row, int column) {
  return EntityId{static_cast<std::uint32_t>(
      row.whole(column, 0, std::numeric_limits<std::uint32_t>::max()))};
}

inline Time time_of_row(const Statement& row, int column) {
  return Time::from_seconds(row.seconds(column));
}

/// The row that a SELECT statement has reached, for columns::take(); its first column is
/// the number of the row.
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
  /// Of the value that was taken last; the statement keeps what is wrong.
  void check(bool good, std::string_view allowed = "what a run stores") {
    if (!good) row_.refuse(column_ - 1, allowed);
  }

 private:
  const Statement& row_;
  int column_ = 1;  // behind the number of the row
};

}  // namespace skein::record
