// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace skein::modem {

/// How datagrams are sealed, and told from those of others. What a seal is made of is the
/// matter of whoever gives the functions; they are called by one thread at a time.
struct DatagramSeal {
  std::size_t bytes = 0;  ///< that a seal has, at the end of a datagram
  /// Appends a seal. The number is that of the datagram in its session, which is part of
  /// what is sealed.
  std::function<void(std::vector<std::byte>& datagram, std::uint64_t number)> put_on;
  /// Whether these bytes, of any number, end with a seal of the same key.
  std::function<bool(std::span<const std::byte> sealed)> is_authentic;
  bool required = true;  ///< what is not authentic is refused; else it is counted only
};

}  // namespace skein::modem
