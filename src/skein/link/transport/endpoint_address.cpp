// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/endpoint_address.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>
#include <system_error>

#include "skein/base/loopback.h"

namespace skein::transport {
namespace {

constexpr std::string_view kForms =
    "udpin:[HOST:]PORT, udpout:HOST:PORT, udpbcast:ADDRESS:PORT, "
    "udpmulti:GROUP:PORT[:INTERFACE], tcpin:[HOST:]PORT, tcp:HOST:PORT, "
    "serial:DEVICE[:BAUD]";

constexpr std::uint32_t kMinBaud = 50, kMaxBaud = 10'000'000;

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty())
    return std::nullopt;
  return value;
}

Error bad(std::string_view text, std::string_view why) {
  return {ErrorCode::kBadInput, "", fmt::format("\"{}\": {}.", text, why),
          fmt::format("Known forms: {}.", kForms)};
}

// HOST:PORT; with `listens` the host may be left out and the port may be 0.
Result<NetworkPlace> parse_place(std::string_view whole, std::string_view text,
                                 bool listens) {
  NetworkPlace place;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string_view::npos) {
    place.host = text.substr(0, colon);
    text.remove_prefix(colon + 1);
  } else if (!listens) {
    return bad(whole, "a host and a port are wanted");
  }
  if (place.host.empty()) return bad(whole, "the host is empty");
  const bool in_brackets = place.host.front() == '[' && place.host.back() == ']';
  if (place.host.find(':') != std::string::npos && !in_brackets)
    return bad(whole, "an IPv6 address is wanted in brackets, as in [::1]:14550");
  const auto port = number<std::uint16_t>(text);
  if (!port || (*port == 0 && !listens))
    return bad(whole,
               fmt::format("\"{}\" is no port from {} to 65535", text, listens ? 0 : 1));
  place.port = *port;
  return place;
}

Result<EndpointAddress> parse_serial(std::string_view whole, std::string_view text) {
  SerialLine line;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string_view::npos) {
    const auto baud = number<std::uint32_t>(text.substr(colon + 1));
    if (!baud || *baud < kMinBaud || *baud > kMaxBaud)
      return bad(whole, fmt::format("\"{}\" is no rate from {} to {} baud",
                                    text.substr(colon + 1), kMinBaud, kMaxBaud));
    line.baud = *baud;
    text = text.substr(0, colon);
  }
  if (text.empty()) return bad(whole, "a device is wanted");
  line.device = text;
  return EndpointAddress(line);
}

// Whether a text is an address of a multicast group.
bool is_group(std::string_view host) {
  const auto first = number<int>(host.substr(0, host.find('.')));
  return first && *first >= 224 && *first <= 239;
}

Result<EndpointAddress> parse_multicast(std::string_view whole, std::string_view text) {
  UdpMulticast multicast;
  const std::size_t last = text.rfind(':');
  if (last != std::string_view::npos && text.find(':') != last) {
    multicast.interface = text.substr(last + 1);
    text = text.substr(0, last);
    if (multicast.interface.empty()) return bad(whole, "the interface is empty");
    if (multicast.interface.ends_with(']'))
      return bad(whole, "the interface is wanted by its IPv4 address");
  }
  auto group = parse_place(whole, text, false);
  if (!group) return group.error();
  if (!is_group(group.value().host))
    return bad(whole, fmt::format("\"{}\" is no address from 224.0.0.0 to "
                                  "239.255.255.255",
                                  group.value().host));
  multicast.group = std::move(group).value();
  return EndpointAddress(multicast);
}

template <class Kind>
Result<EndpointAddress> as(const Result<NetworkPlace>& place) {
  if (!place) return place.error();
  return EndpointAddress(Kind{place.value()});
}

struct TextOf {
  static std::string place(std::string_view kind, const NetworkPlace& at) {
    return fmt::format("{}:{}:{}", kind, at.host, at.port);
  }
  std::string operator()(const UdpServer& e) const { return place("udpin", e.at); }
  std::string operator()(const UdpClient& e) const { return place("udpout", e.to); }
  std::string operator()(const UdpBroadcast& e) const { return place("udpbcast", e.to); }
  std::string operator()(const TcpServer& e) const { return place("tcpin", e.at); }
  std::string operator()(const TcpClient& e) const { return place("tcp", e.to); }
  std::string operator()(const UdpMulticast& e) const {
    return place("udpmulti", e.group) + ":" + e.interface;
  }
  std::string operator()(const SerialLine& e) const {
    return fmt::format("serial:{}:{}", e.device, e.baud);
  }
};

}  // namespace

Result<EndpointAddress> parse_endpoint(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest =
      colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  if (kind == "udpin") return as<UdpServer>(parse_place(text, rest, true));
  if (kind == "udpout") return as<UdpClient>(parse_place(text, rest, false));
  if (kind == "udpbcast") return as<UdpBroadcast>(parse_place(text, rest, false));
  if (kind == "udpmulti") return parse_multicast(text, rest);
  if (kind == "tcpin") return as<TcpServer>(parse_place(text, rest, true));
  if (kind == "tcp") return as<TcpClient>(parse_place(text, rest, false));
  if (kind == "serial") return parse_serial(text, rest);
  return bad(text, fmt::format("\"{}\" is no kind of endpoint", kind));
}

EndpointAddress moved(const EndpointAddress& address, int ports) {
  struct Mover {
    int by;
    void to(std::uint16_t& port) const { port = static_cast<std::uint16_t>(port + by); }
    void operator()(UdpServer& a) const { to(a.at.port); }
    void operator()(TcpServer& a) const { to(a.at.port); }
    void operator()(UdpClient& a) const { to(a.to.port); }
    void operator()(UdpBroadcast& a) const { to(a.to.port); }
    void operator()(TcpClient& a) const { to(a.to.port); }
    void operator()(UdpMulticast& a) const { to(a.group.port); }
    void operator()(SerialLine&) const {}
  };
  EndpointAddress other = address;
  std::visit(Mover{ports}, other);
  return other;
}

std::string text_of(const EndpointAddress& address) {
  return std::visit(TextOf(), address);
}

std::optional<EndpointAddress> counterpart(const EndpointAddress& address) {
  if (const auto* server = std::get_if<UdpServer>(&address)) return UdpClient{server->at};
  if (const auto* server = std::get_if<TcpServer>(&address)) return TcpClient{server->at};
  if (const auto* client = std::get_if<UdpClient>(&address)) return UdpServer{client->to};
  if (const auto* client = std::get_if<TcpClient>(&address)) return TcpServer{client->to};
  return std::nullopt;
}

namespace {

struct IsLocal {
  bool operator()(const UdpServer& a) const { return is_loopback(a.at.host); }
  bool operator()(const TcpServer& a) const { return is_loopback(a.at.host); }
  bool operator()(const UdpClient& a) const { return is_loopback(a.to.host); }
  bool operator()(const TcpClient& a) const { return is_loopback(a.to.host); }
  bool operator()(const UdpBroadcast& a) const { return is_loopback(a.to.host); }
  bool operator()(const UdpMulticast& a) const { return is_loopback(a.interface); }
  bool operator()(const SerialLine& a) const {
    std::error_code error;
    const auto device = std::filesystem::canonical(a.device, error);
    return !error && device.string().starts_with("/dev/pts/");
  }
};

}  // namespace

bool is_local(const EndpointAddress& address) {
  return std::visit(IsLocal{}, address);
}

}  // namespace skein::transport
