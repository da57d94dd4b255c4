// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/message_table.h"

#include <array>
#include <tuple>
#include <utility>

#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/payload.h"

namespace skein::mavlink {
namespace {

constexpr std::size_t kMessages = std::tuple_size_v<AllMessages>;

template <Message T>
constexpr MessageEntry entry_of() {
  constexpr Facts kOf = kFacts<T>;
  return {kOf.id,
          kOf.name,
          kOf.crc_extra,
          static_cast<std::uint8_t>(kBaseLength<T>),
          static_cast<std::uint8_t>(kLength<T>),
          static_cast<std::uint8_t>(detail::offset_of<T>("target_system")),
          static_cast<std::uint8_t>(detail::offset_of<T>("target_component"))};
}

constexpr std::array<MessageEntry, kMessages> kEntries =
    []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{entry_of<std::tuple_element_t<I, AllMessages>>()...};
}
(std::make_index_sequence<kMessages>());

// One more than the place of an id among the entries; 0: none.
static_assert(kMessages < 256);
constexpr std::size_t kIds = kEntries.back().id + 1;
constexpr std::array<std::uint8_t, kIds> kPlaces = [] {
  std::array<std::uint8_t, kIds> places{};
  for (std::size_t i = 0; i < kMessages; ++i)
    places[kEntries[i].id] = static_cast<std::uint8_t>(i + 1);
  return places;
}();

}  // namespace

std::span<const MessageEntry> all_messages() {
  return kEntries;
}

const MessageEntry* find_message(std::uint32_t id) {
  if (id >= kIds || kPlaces[id] == 0) return nullptr;
  return &kEntries[kPlaces[id] - 1U];
}

}  // namespace skein::mavlink
