// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
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

/// The first IPv4 address of a place, or the IPv6 one in its brackets.
/// @tparam Protocol  Asio's tcp or udp.
/// Fails: kBadInput for a host without one.
template <class Protocol>
Result<typename Protocol::endpoint> resolve(boost::asio::io_context& io,
                                            const NetworkPlace& place) {
  boost::system::error_code error;
  if (place.host.starts_with('[')) {
    const auto address = boost::asio::ip::make_address_v6(
        place.host.substr(1, place.host.find(']') - 1), error);
    if (error) return bad_place(place, error);
    return typename Protocol::endpoint(address, place.port);
  }
  typename Protocol::resolver resolver(io);
  const auto found =
      resolver.resolve(Protocol::v4(), place.host, std::to_string(place.port), error);
  if (error) return bad_place(place, error);
  return found.begin()->endpoint();
}

/// HOST:PORT of an address, as parse_endpoint() reads it.
template <class Address>
std::string name_of(const Address& at) {
  if (at.address().is_v6())
    return fmt::format("[{}]:{}", at.address().to_string(), at.port());
  return fmt::format("{}:{}", at.address().to_string(), at.port());
}

}  // namespace skein::transport
