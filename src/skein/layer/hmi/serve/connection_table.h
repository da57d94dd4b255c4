// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace skein::hmi {

/// Where a connection comes from, as far as connections and wrong logins are counted
/// together: an IPv4 address, also where it is written as IPv6 ("::ffff:10.0.0.7"); the
/// first 64 bits of an IPv6 address, which is what one household or machine has; all
/// addresses of this machine's loopback as one.
/// @param address  as text; anything else is its own group.
std::string address_group(std::string_view address);

/// How many connections there may be.
struct ConnectionLimits {
  std::size_t in_all = 640;
  std::size_t per_address = 320;
};

/// Who is connected: so many in all and of each address. Where there is no room, who has
/// waited longest without asking for anything goes; where everybody is being served, the
/// newcomer does.
///
/// Not safe for several threads.
class ConnectionTable {
 public:
  using Number = std::uint64_t;

  explicit ConnectionTable(const ConnectionLimits& limits) : limits_(limits) {}

  struct Entry {
    std::optional<Number> taken;    ///< nothing: there is no room
    std::optional<Number> evicted;  ///< who is to be closed for it
  };
  /// One more of an address group; it waits.
  Entry enter(const std::string& group);
  /// @param waits  it has nothing that is being answered.
  void set_waiting(Number number, bool waits);
  void leave(Number number);

  std::size_t size() const { return connections_.size(); }

 private:
  struct Connection {
    std::string group;
    std::optional<std::uint64_t> waits_since;  // order of such moments
  };
  std::optional<Number> longest_waiting(const std::string* group) const;

  ConnectionLimits limits_;
  std::map<Number, Connection> connections_;
  std::map<std::string, std::size_t, std::less<>> of_group_;
  Number counted_ = 0;
  std::uint64_t moments_ = 0;
};

}  // namespace skein::hmi
