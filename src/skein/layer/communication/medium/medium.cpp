#include "skein/layer/communication/medium/medium.h"

#include <utility>

#include "skein/base/check.h"
#include "skein/layer/communication/medium/dcf.h"
#include "skein/layer/communication/medium/direct_access.h"
#include "skein/layer/communication/medium/tdma.h"

namespace skein::communication {
namespace {

std::unique_ptr<Access> make_access(const RadioProfile& profile, Links& links,
                                    Schedule& schedule, PacketStore& packets,
                                    MediumListener& listener, std::uint64_t seed) {
  switch (profile.mac.access) {
    case AccessMethod::kTdma:
      return std::make_unique<Tdma>(profile, links.size(), schedule, packets, listener);
    case AccessMethod::kDirect:
      return std::make_unique<DirectAccess>(profile, links, schedule, packets, listener,
                                            seed);
    case AccessMethod::kDcf:
      break;
  }
  return std::make_unique<Dcf>(profile, links, schedule, packets, listener, seed);
}

}  // namespace

Medium::Medium(const RadioProfile& profile, const Propagation& propagation,
               Links::Nodes nodes, std::uint64_t seed, MediumListener& listener)
    : profile_(profile),
      links_(profile_.phy, propagation, std::move(nodes)),
      access_(make_access(profile_, links_, schedule_, packets_, listener, seed)),
      channel_(profile_.phy, links_, schedule_, *access_, seed) {
  access_->use(channel_);
}

void Medium::advance(Time until) {
  SKEIN_CHECK(until >= now_);
  while (!schedule_.empty() && schedule_.next_time() < until) {
    const Schedule::Event event = schedule_.take();
    now_ = event.time;
    if (event.kind < EventKind::kAccess)
      channel_.handle(event);
    else
      access_->handle(event);
  }
  now_ = until;
}

bool Medium::send(const PacketOrder& order) {
  SKEIN_CHECK(order.from < links_.size() &&
              (order.to < links_.size() || order.to == kAllNodes));
  if (!access_->has_room(order.from)) return false;
  access_->enqueue(packets_.add(order, now_), now_);
  return true;
}

std::vector<NodeIndex> Medium::in_range(NodeIndex from) {
  std::vector<NodeIndex> found;
  for (const Link& link : links_.of(from, now_))
    if (channel_.in_range(link)) found.push_back(link.to);
  return found;
}

}  // namespace skein::communication
