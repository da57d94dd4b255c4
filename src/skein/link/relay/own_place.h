// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>

#include "skein/base/loopback.h"
#include "skein/base/result.h"

namespace skein::relay {

/// Whether a relay that listens at `here` and calls `there` is fine.
/// @tparam Address  an endpoint of Asio.
/// Fails: kBadInput where it would call itself.
template <class Address>
Result<void> check_not_itself(const Address& here, const Address& there) {
  const bool same_host =
      here.address() == there.address() ||
      (here.address().is_unspecified() && is_loopback(there.address().to_string()));
  if (here.port() != there.port() || !same_host) return {};
  return Error{ErrorCode::kBadInput,
               fmt::format("{}:{}", there.address().to_string(), there.port()),
               "the relay would call itself: it listens there.",
               "Let it listen at another port."};
}

}  // namespace skein::relay
