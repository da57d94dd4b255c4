#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/base/id.h"
#include "skein/link/modem/datagram.h"

namespace skein::modem {

/// How those behind a gateway learn by which way others are reached.
enum class GatewayMethod : std::uint8_t {
  kFixed,     ///< they know the gateway's address, and others by their true ones
  kAltering,  ///< the gateway passes others on as if they were itself
};

/// Somebody who sends: where he is, and what he knows.
struct Node {
  Address own;
  bool has_modem = false;  ///< of its own
  std::optional<Address> gateway = {};
};

/// To whom a message is handed.
enum class Way : std::uint8_t {
  kLocal,    ///< the identity of that address, behind the same modem
  kModem,    ///< its own modem
  kGateway,  ///< whoever has one
  kNone,     ///< it has neither
};

/// The way from a node to an address: with the same modem it stays here, else it goes to
/// the own modem, else to the gateway. Messages to all go both ways; this is the way out.
Way way_of(const Node& node, Address to);

/// What a gateway knows of those on the other side of its modem.
class Gateway {
 public:
  Gateway(Address own, GatewayMethod method) : own_(own), method_(method) {}

  /// Passes the advertisement of somebody on the other side on to those behind the
  /// gateway, and keeps the true address.
  /// @returns  the address under which they know it
  Address pass_on(Address heard);

  /// It is not heard any more.
  void forget(EntityId who) { true_.erase(who); }

  /// The address under which those behind the gateway know somebody.
  std::optional<Address> known_as(EntityId who) const;

  /// What a node behind the gateway has sent to an address: where it goes by the modem.
  /// None: it stays here, or nobody of that identity is on the other side.
  std::optional<Address> way_out(const Node& from, Address to, EntityId who) const;

 private:
  Address seen_as(Address heard) const {
    return method_ == GatewayMethod::kAltering ? own_ : heard;
  }

  Address own_;
  GatewayMethod method_;
  std::map<EntityId, Address> true_;
};

}  // namespace skein::modem
