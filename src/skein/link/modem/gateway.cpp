#include "skein/link/modem/gateway.h"

namespace skein::modem {

Way way_of(const Node& node, Address to) {
  if (to.hw == node.own.hw) return Way::kLocal;
  if (node.has_modem) return Way::kModem;
  return node.gateway ? Way::kGateway : Way::kNone;
}

Address Gateway::pass_on(Address heard) {
  true_[EntityId{heard.sw}] = heard;
  return seen_as(heard);
}

std::optional<Address> Gateway::known_as(EntityId who) const {
  const auto found = true_.find(who);
  if (found == true_.end()) return std::nullopt;
  return seen_as(found->second);
}

std::optional<Address> Gateway::way_out(const Node& from, Address to,
                                        EntityId who) const {
  const Way way = way_of(from, to);
  // Local is the gateway itself where it stands for others.
  const bool reaches = way == Way::kModem ||
                       (way == Way::kGateway && from.gateway == own_) ||
                       (way == Way::kLocal && to == own_);
  const auto found = true_.find(who);
  if (!reaches || found == true_.end()) return std::nullopt;
  return found->second;
}

}  // namespace skein::modem
