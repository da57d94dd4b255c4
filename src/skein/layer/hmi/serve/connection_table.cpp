// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/connection_table.h"

#include <utility>  // before Asio, which lacks it in C++20

#include <algorithm>
#include <boost/asio/ip/address.hpp>

#include "skein/base/loopback.h"

namespace skein::hmi {

std::string address_group(std::string_view address) {
  if (is_loopback(address)) return "loopback";
  boost::system::error_code failure;
  const auto parsed = boost::asio::ip::make_address(std::string(address), failure);
  if (failure || parsed.is_v4()) return std::string(address);
  auto v6 = parsed.to_v6();
  if (v6.is_v4_mapped())
    return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, v6).to_string();
  auto bytes = v6.to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  return boost::asio::ip::address_v6(bytes).to_string();
}

ConnectionTable::Entry ConnectionTable::enter(const std::string& group) {
  const auto found = of_group_.find(group);
  const bool group_full =
      found != of_group_.end() && found->second >= limits_.per_address;
  Entry entry;
  if (group_full || connections_.size() >= limits_.in_all) {
    entry.evicted = longest_waiting(group_full ? &group : nullptr);
    if (!entry.evicted) return entry;
    leave(*entry.evicted);
  }
  entry.taken = ++counted_;
  connections_[*entry.taken] = {group, ++moments_};
  ++of_group_[group];
  return entry;
}

std::optional<ConnectionTable::Number> ConnectionTable::longest_waiting(
    const std::string* group) const {
  std::optional<Number> longest;
  std::uint64_t since = 0;
  for (const auto& [number, connection] : connections_) {
    if (!connection.waits_since || (group && connection.group != *group)) continue;
    if (longest && *connection.waits_since >= since) continue;
    longest = number;
    since = *connection.waits_since;
  }
  return longest;
}

void ConnectionTable::set_waiting(Number number, bool waits) {
  const auto found = connections_.find(number);
  if (found == connections_.end()) return;
  if (waits)
    found->second.waits_since = ++moments_;
  else
    found->second.waits_since.reset();
}

void ConnectionTable::leave(Number number) {
  const auto found = connections_.find(number);
  if (found == connections_.end()) return;
  const auto group = of_group_.find(found->second.group);
  if (group != of_group_.end() && --group->second == 0) of_group_.erase(group);
  connections_.erase(found);
}

}  // namespace skein::hmi
