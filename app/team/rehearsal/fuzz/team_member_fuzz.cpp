// SPDX-License-Identifier: Apache-2.0
// Any bytes as messages drive a member: it goes on, and what it sends is a message.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/base/check.h"
#include "skein/data/describe/wire.h"
#include "skein/layer/reasoning/team/protocol/team_member.h"

// Each message: sender, to all or not, time that passes, length, bytes of the wire form.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein;
  if (size == 0) return 0;
  reasoning::TeamConfig config;
  config.structure = static_cast<reasoning::TeamStructure>(data[0] % 4);
  config.fixed_leader = EntityId{2};
  config.approval = (data[0] & 8) != 0;
  if ((data[0] & 16) != 0)
    config.operators = {(data[0] & 32) != 0 ? EntityId{3} : EntityId{2}};
  reasoning::TeamMember member({3}, config);
  std::vector<TeamTask> tasks(3);
  for (std::uint32_t k = 0; k < 3; ++k) tasks[k].number = k + 1;
  if ((data[0] & 4) != 0) member.submit("M", tasks, Time());
  double now = 0;
  std::size_t at = 1;
  while (at + 4 <= size) {
    const std::uint8_t* head = data + at;
    at += 4;
    const std::size_t length = std::min<std::size_t>(head[3], size - at);
    const auto message =
        wire::decode<TeamMessage>(std::as_bytes(std::span(data + at, length)));
    at += length;
    now += head[2] / 16.0;
    std::vector<reasoning::TeamReceived> received;
    if (message)
      received.push_back({{head[0] % 8U}, (head[1] & 1) != 0, message.value()});
    if ((head[1] & 2) != 0) member.leave();
    if ((head[1] & 4) != 0) member.decide(head[0] & 8U, (head[1] & 8) != 0);
    const reasoning::TeamStep step = member.step(Time::from_seconds(now), received);
    for (const reasoning::TeamOutgoing& out : step.send)
      SKEIN_CHECK(!reasoning::is_implausible(out.message.content));
    SKEIN_CHECK(member.status().members.size() <= 1001);
    for (const std::uint32_t task : member.tasks()) SKEIN_CHECK(task < UINT32_MAX);
  }
  return 0;
}
