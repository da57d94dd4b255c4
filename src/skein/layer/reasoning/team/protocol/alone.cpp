// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/alone.h"

#include <algorithm>

namespace skein::reasoning {

void TeamAlone::step(MemberState& member) {
  member.finish_own();
  auto tasks = member.knowledge.open();
  const TeamResources& own = member.own.resources();
  if (member.config.structure == TeamStructure::kNone) {
    const TeamWorker self = member.own_worker();
    if (own.able)
      member.execute(
          orderable(member.config.allocate(tasks, {&self, 1}).given[member.self], tasks));
    return member.set_status(TeamReason::kAlone);
  }
  for (const EntityId id : auction_.bidders()) {
    const auto* contact = member.contacts.find(id);
    if (!contact || member.now - contact->heard > member.lost) auction_.drop(id);
  }
  std::erase_if(tasks, [&own](const TeamTask& task) {
    return !task.after.empty() || refuses(own, task.number);
  });
  if (auction_.bid(member.self, own, tasks, member.config.utility, member.config.bundle))
    member.next_inform = std::min(member.next_inform, member.now);
  member.execute(auction_.won());
  member.set_status(TeamReason::kAlone);
}

void TeamAlone::send(MemberState& member) {
  if (!member.takes_part_in_auction() || !member.mission) return;
  member.outbox.send_all(TeamBids{*member.mission, auction_.known(member.self)});
  const std::uint32_t number = member.knowledge.number();
  if (std::ranges::any_of(member.contacts.all(), [&](const auto& contact) {
        return member.now - contact.second.informed <= member.lost &&
               contact.second.inform.state_number != number;
      }))
    member.outbox.send_all(member.knowledge.next_part({member.self}));
}

void TeamAlone::on(MemberState& member, const TeamBids& bids) {
  if (member.mission && bids.mission == *member.mission) auction_.take(member.self, bids);
}

void TeamAlone::on(MemberState& member, EntityId from, const TeamState& state) {
  const auto* contact = member.contacts.find(from);
  if (contact && member.is_of_lineage(contact->inform.mission))
    member.allocation_due |= member.knowledge.add(
        state, member.mission ? member.mission->branch : std::nullopt);
}

}  // namespace skein::reasoning
