// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/proposal_display.h"

#include <fmt/format.h>

namespace skein::reasoning {

std::string member_name(const TeamConfig& config, EntityId id) {
  const auto known = config.names.find(id);
  return known == config.names.end() ? fmt::format("{}", id.value) : known->second;
}

std::string text_of(const TeamConfig& config, EntityId proposer,
                    const TeamProposal& proposal) {
  std::string text =
      fmt::format("{} of {}:", proposal.number, member_name(config, proposer));
  for (const TeamShare& share : proposal.shares)
    text += fmt::format("{} {} flies {}", &share == proposal.shares.data() ? "" : ",",
                        member_name(config, share.member), share.task);
  if (proposal.shares.empty()) text += " nobody flies";
  if (proposal.value && proposal.bound)
    text += fmt::format(" (utility {:.2f} of at most {:.2f})", *proposal.value,
                        *proposal.bound);
  return text;
}

}  // namespace skein::reasoning
