// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/negotiation/negotiation_batch.h"

#include <fmt/format.h>

#include <iterator>
#include <set>

#include "skein/data/describe/strict_json.h"

namespace skein::reasoning {
namespace {

using strict_json::Problems;
using strict_json::Value;

constexpr std::size_t kMaxBargains = 100'000;
constexpr std::size_t kMaxOptions = 1000;
constexpr std::size_t kMaxIdBytes = 64;

std::vector<double> utilities_of(const Value& list) {
  std::vector<double> all;
  for (const Value& item : list.items(kMaxOptions)) all.push_back(item.number(0, 1));
  if (list.json().is_array() && all.empty() && list.json().empty())
    list.report("must have an option at least.");
  return all;
}

void read_free(const Value& rows, Bargain& bargain) {
  const auto all = rows.items(kMaxOptions);
  if (rows.json().is_array() && all.size() != bargain.u1.size())
    return rows.report(fmt::format("has {} rows for the {} options of utility_1.",
                                   all.size(), bargain.u1.size()));
  for (const Value& row : all) {
    const auto cells = row.items(kMaxOptions);
    if (row.json().is_array() && cells.size() != bargain.u2.size())
      return row.report(fmt::format("has {} cells for the {} options of utility_2.",
                                    cells.size(), bargain.u2.size()));
    for (const Value& cell : cells)
      bargain.free.push_back(static_cast<std::uint8_t>(cell.integer(0, 1)));
  }
}

NamedBargain read_bargain(const Value& value) {
  NamedBargain read;
  if (!value.is_object_of({"id", "utility_1", "utility_2", "free"},
                          {"sum", "product", "zeuthen", "rounds"}))
    return read;
  read.id = value.at("id").text(kMaxIdBytes);
  read.bargain.u1 = utilities_of(value.at("utility_1"));
  read.bargain.u2 = utilities_of(value.at("utility_2"));
  read_free(value.at("free"), read.bargain);
  return read;
}

// As a cell: in quotation marks where a comma or one of them is in it.
std::string cell_of(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

Result<std::vector<NamedBargain>> read_bargains(std::string_view text,
                                                const std::string& name) {
  Problems problems(name);
  std::vector<NamedBargain> all;
  if (const auto json = strict_json::parse(text, problems)) {
    std::set<std::string> ids;
    for (const Value& item : Value(*json, "", problems).items(kMaxBargains)) {
      all.push_back(read_bargain(item));
      if (!all.back().id.empty() && !ids.insert(all.back().id).second)
        item.report(fmt::format("the id \"{}\" is there twice.", all.back().id));
      if (problems.full()) break;
    }
  }
  if (problems.any()) return problems.error();
  return all;
}

std::string deals_csv(const std::vector<NamedBargain>& bargains) {
  std::string out = "id,sum_k,sum_l,product_k,product_l,zeuthen_k,zeuthen_l,rounds\n";
  for (const NamedBargain& named : bargains) {
    const auto sum = agree(DealRule::kSum, named.bargain);
    out += cell_of(named.id);
    if (!sum) {
      out += ",,,,,,,\n";
      continue;
    }
    const auto product = agree(DealRule::kProduct, named.bargain);
    const auto zeuthen = agree(DealRule::kZeuthen, named.bargain);
    fmt::format_to(std::back_inserter(out), ",{},{},{},{},{},{},{}\n", sum->deal.k,
                   sum->deal.l, product->deal.k, product->deal.l, zeuthen->deal.k,
                   zeuthen->deal.l, zeuthen->rounds);
  }
  return out;
}

}  // namespace skein::reasoning
