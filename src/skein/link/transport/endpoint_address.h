#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "skein/base/result.h"

/// Where bytes come from and go to, as texts that users of MAVLink know:
///
///   udpin:[HOST:]PORT      waits for datagrams, answers each sender
///   udpout:HOST:PORT       sends to one place
///   udpbcast:ADDRESS:PORT  sends to all of a network
///   tcpin:[HOST:]PORT      waits for connections
///   tcp:HOST:PORT          connects, again and again
///   serial:DEVICE[:BAUD]   a serial line or pseudo-terminal; 57600 without a rate
///
/// Without a host, only programs of the same machine are let in: 127.0.0.1.
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

using EndpointAddress =
    std::variant<UdpServer, UdpClient, UdpBroadcast, TcpServer, TcpClient, SerialLine>;

/// Fails: kBadInput for a text of none of these forms, naming what is wrong with it.
Result<EndpointAddress> parse_endpoint(std::string_view text);

/// The same with a port that is higher by `ports`; a serial line as it is.
EndpointAddress moved(const EndpointAddress& address, int ports);

/// The text that parse_endpoint() reads as this address.
std::string text_of(const EndpointAddress& address);

}  // namespace skein::transport
