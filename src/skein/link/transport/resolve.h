// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/system/error_code.hpp>
#include <string>

#include "skein/base/result.h"
#include "skein/link/transport/endpoint_address.h"

namespace skein::transport {

inline Error bad_place(const NetworkPlace& place,
                       const boost::system::error_code& error) {
  return {ErrorCode::kBadInput, fmt::format("{}:{}", place.host, place.port),
          error.message() + ".", ""};
}

/// The first address of a place.
/// @tparam Protocol  Asio's tcp or udp.
/// Fails: kBadInput for a host without one.
template <class Protocol>
Result<typename Protocol::endpoint> resolve(boost::asio::io_context& io,
                                            const NetworkPlace& place) {
  boost::system::error_code error;
  typename Protocol::resolver resolver(io);
  const auto found =
      resolver.resolve(Protocol::v4(), place.host, std::to_string(place.port), error);
  if (error) return bad_place(place, error);
  return found.begin()->endpoint();
}

/// HOST:PORT of an address.
template <class Address>
std::string name_of(const Address& at) {
  return fmt::format("{}:{}", at.address().to_string(), at.port());
}

}  // namespace skein::transport
