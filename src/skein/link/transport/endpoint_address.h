// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "skein/base/result.h"

/// Where bytes come from and go to, as texts that users of MAVLink know:
///
///   udpin:[HOST:]PORT      waits for datagrams, answers each sender
///   udpout:HOST:PORT       sends to one place
///   udpbcast:ADDRESS:PORT  sends to all of a network
///   udpmulti:GROUP:PORT[:INTERFACE]  sends to all of a multicast group, and hears them;
///                          by the network of the interface's address
///   tcpin:[HOST:]PORT      waits for connections
///   tcp:HOST:PORT          connects, again and again
///   serial:DEVICE[:BAUD]   a serial line or pseudo-terminal; 57600 without a rate
///
/// Without a host, only programs of the same machine are let in: 127.0.0.1. An IPv6
/// address stands in brackets: `udpout:[::1]:14550`; `[::]` is reached by IPv4 as well.
namespace skein::transport {

struct NetworkPlace {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0 with udpin and tcpin: any free one
};

struct UdpServer {
  NetworkPlace at;
};
struct UdpClient {
  NetworkPlace to;
};
struct UdpBroadcast {
  NetworkPlace to;
};
struct UdpMulticast {
  NetworkPlace group;                   ///< an address from 224.0.0.0 to 239.255.255.255
  std::string interface = "127.0.0.1";  ///< address of this machine in the network
};
struct TcpServer {
  NetworkPlace at;
};
struct TcpClient {
  NetworkPlace to;
};
struct SerialLine {
  std::string device;
  std::uint32_t baud = 57'600;
};

using EndpointAddress = std::variant<UdpServer, UdpClient, UdpBroadcast, TcpServer,
                                     TcpClient, SerialLine, UdpMulticast>;

/// Fails: kBadInput for a text of none of these forms, naming what is wrong with it.
Result<EndpointAddress> parse_endpoint(std::string_view text);

/// The same with a port that is higher by `ports`; a serial line as it is.
EndpointAddress moved(const EndpointAddress& address, int ports);

/// The text that parse_endpoint() reads as this address.
std::string text_of(const EndpointAddress& address);

/// Whether only programs of this machine can be met there: loopback addresses (as
/// is_loopback() has them) and pseudo-terminals.
bool is_local(const EndpointAddress& address);

/// The other end of the line, for another program of the same machine: a client for a
/// server and a server for a client; none for the others.
std::optional<EndpointAddress> counterpart(const EndpointAddress& address);

}  // namespace skein::transport
