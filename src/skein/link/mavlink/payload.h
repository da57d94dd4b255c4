// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include "skein/data/describe/describe.h"
#include "skein/data/describe/type_traits.h"
#include "skein/link/mavlink/facts.h"

/// Messages as they lie in a frame: little-endian, base fields by falling size of their
/// elements, then the extensions in their order, nothing aligned.
namespace skein::mavlink {

static_assert(std::endian::native == std::endian::little,
              "numbers are copied as they lie in memory");

/// A struct of the table of messages.
template <class T>
concept Message = Described<T> && requires(const T* t) {
  facts_of(t).crc_extra;
};

template <Message T>
inline constexpr Facts kFacts = facts_of(static_cast<const T*>(nullptr));

namespace detail {

template <class M>
struct Element {
  using type = M;
};
template <class Item, std::size_t N>
struct Element<std::array<Item, N>> {
  using type = Item;
};

template <Message T>
inline constexpr std::size_t kFieldCount =
    std::remove_const_t<decltype(kDescription<T>)>::kFields;

// Where each field lies in the payload, in the order of the description.
template <Message T>
inline constexpr auto kOffsets = [] {
  std::array<std::size_t, kFieldCount<T>> element{}, size{}, offset{};
  std::size_t at = 0;
  for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>&) {
    element[at] = sizeof(typename Element<M>::type);
    size[at++] = sizeof(M);
  });
  std::size_t end = 0;
  for (const std::size_t width : {8U, 4U, 2U, 1U})
    for (std::size_t i = 0; i < kFacts<T>.base_fields; ++i)
      if (element[i] == width) {
        offset[i] = end;
        end += size[i];
      }
  for (std::size_t i = kFacts<T>.base_fields; i < kFieldCount<T>; ++i) {
    offset[i] = end;
    end += size[i];
  }
  return offset;
}();

template <Message T>
constexpr std::size_t length_of(std::size_t fields) {
  std::size_t at = 0, sum = 0;
  for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>&) {
    if (at++ < fields) sum += sizeof(M);
  });
  return sum;
}

// Calls visit(field, offset in the payload) for each field.
template <Message T, class Visit>
void for_each_place(Visit&& visit) {
  std::size_t at = 0;
  for_each_field<T>([&](const auto& field) { visit(field, kOffsets<T>[at++]); });
}

// Where the field of a name lies; kNowhere without one.
inline constexpr std::size_t kNowhere = 255;
template <Message T>
constexpr std::size_t offset_of(std::string_view name) {
  std::size_t at = 0, found = kNowhere;
  for_each_field<T>([&](const auto& field) {
    if (field.name == name) found = kOffsets<T>[at];
    ++at;
  });
  return found;
}

}  // namespace detail

/// Bytes of the payload without extensions, as version 1 sends it.
template <Message T>
inline constexpr std::size_t kBaseLength = detail::length_of<T>(kFacts<T>.base_fields);

/// Bytes of the whole payload.
template <Message T>
inline constexpr std::size_t kLength = detail::length_of<T>(detail::kFieldCount<T>);

inline constexpr std::size_t kMaxPayload = 255;

/// The message as it lies in a frame, with all its zeros.
template <Message T>
std::array<std::byte, kLength<T>> pack(const T& message) {
  static_assert(kLength<T> <= kMaxPayload);
  std::array<std::byte, kLength<T>> payload;
  detail::for_each_place<T>([&](const auto& field, std::size_t offset) {
    const auto& value = message.*field.member;
    std::memcpy(payload.data() + offset, &value, sizeof value);
  });
  return payload;
}

/// The message in a payload: what a short one lacks is 0, what a long one has more is
/// of a newer definition and left out. Floats keep every bit, NaN too.
template <Message T>
T unpack(std::span<const std::byte> payload) {
  std::array<std::byte, kLength<T>> whole{};
  std::copy_n(payload.begin(), std::min(payload.size(), whole.size()), whole.begin());
  T message;
  detail::for_each_place<T>([&](const auto& field, std::size_t offset) {
    auto& value = message.*field.member;
    std::memcpy(&value, whole.data() + offset, sizeof value);
  });
  return message;
}

/// The bytes in an array of characters: ended by a zero only where there are fewer. They
/// are a vehicle's: to compare with; who keeps or shows them calls valid_text() first.
template <std::size_t N>
std::string_view text_of(const std::array<char, N>& field) {
  return {field.data(), static_cast<std::size_t>(
                            std::find(field.begin(), field.end(), '\0') - field.begin())};
}

/// Fills an array of characters; of a text that is too long the begin.
template <std::size_t N>
void set_text(std::array<char, N>& field, std::string_view text) {
  field.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), N), field.begin());
}

}  // namespace skein::mavlink
