// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/table/csv_cells.h"

#include <charconv>

namespace skein::exchange {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<std::string_view> CsvCells::next() {
  if (at_end_) return std::nullopt;
  std::size_t end = 0;
  bool quoted = false;
  for (; end < rest_.size() && (quoted || rest_[end] != ','); ++end)
    if (rest_[end] == '"') quoted = !quoted;
  std::string_view cell = trimmed(rest_.substr(0, end));
  at_end_ = end == rest_.size();
  rest_.remove_prefix(at_end_ ? end : end + 1);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
    cell = trimmed(cell.substr(1, cell.size() - 2));
  return cell;
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] =
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace skein::exchange
