// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/packed_task.h"

#include <cstddef>
#include <span>
#include <utility>

#include "skein/data/describe/wire.h"

namespace skein::reasoning {

std::vector<std::uint8_t> packed(const TaskKind& task) {
  std::vector<std::byte> bytes;
  wire::encode(task, bytes);
  std::vector<std::uint8_t> all;
  all.reserve(bytes.size());
  for (const std::byte byte : bytes) all.push_back(std::to_integer<std::uint8_t>(byte));
  return all;
}

std::string name_of_kind(const TeamTask& task) {
  const auto what = unpacked(task);
  return std::string(what ? kind_of(*what) : "nothing");
}

std::optional<TaskKind> unpacked(const TeamTask& task) {
  auto decoded = wire::decode<TaskKind>(std::as_bytes(std::span(task.what)));
  if (!decoded || !task_error(decoded.value()).empty()) return std::nullopt;
  return std::move(decoded).value();
}

}  // namespace skein::reasoning
