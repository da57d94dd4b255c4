#include "skein/layer/communication/medium/medium.h"

#include <utility>

#include "skein/base/check.h"

namespace skein::communication {

Medium::Medium(const RadioProfile& profile, const Propagation& propagation,
               Links::Nodes nodes, std::uint64_t seed, MediumListener& listener)
    : profile_(profile),
      links_(profile_.phy, propagation, std::move(nodes)),
      dcf_(profile_, links_.size(), schedule_, packets_, listener, seed),
      channel_(profile_.phy, links_, schedule_, dcf_, seed) {
  dcf_.use(channel_);
}

void Medium::advance(Time until) {
  SKEIN_CHECK(until >= now_);
  while (!schedule_.empty() && schedule_.next_time() < until) {
    const Schedule::Event event = schedule_.take();
    now_ = event.time;
    if (event.kind < EventKind::kAccess)
      channel_.handle(event);
    else
      dcf_.handle(event);
  }
  now_ = until;
}

bool Medium::send(const PacketOrder& order) {
  SKEIN_CHECK(order.from < links_.size() &&
              (order.to < links_.size() || order.to == kAllNodes));
  if (!dcf_.has_room(order.from)) return false;
  dcf_.enqueue(packets_.add(order, now_), now_);
  return true;
}

std::vector<NodeIndex> Medium::in_range(NodeIndex from) {
  std::vector<NodeIndex> found;
  for (const Link& link : links_.of(from, now_))
    if (channel_.in_range(link)) found.push_back(link.to);
  return found;
}

}  // namespace skein::communication
