// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "skein/data/describe/describe.h"
#include "skein/data/describe/type_traits.h"
#include "skein/link/mavlink/payload.h"

/// Values of messages that two programs know of each other without having been told:
/// tools/interop/values.mjs makes the same ones. Rounds differ in their style:
///
///   0 all zero    1 greatest, infinite, full texts    2 lowest, empty texts
///   3 NaN, else pseudo-random    4 pseudo-random, half of it zero    5 pseudo-random
///
/// and begin again with others at 6.
namespace skein::mavlink {

/// A field without its C++ type.
struct AnyField {
  std::string_view name, type;  ///< of the definitions: "uint8_t", "float", "char"
  std::size_t width = 0;        ///< of an element [bytes]
  std::size_t count = 0;        ///< of an array; 0: not one
  bool extension = false;
  void* place = nullptr;

  std::size_t elements() const { return count == 0 ? 1 : count; }
};

class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  virtual void visit(const AnyField& field) = 0;
};

template <class Item>
constexpr std::string_view type_name() {
  if constexpr (std::is_same_v<Item, float>) return "float";
  if constexpr (std::is_same_v<Item, char>) return "char";
  constexpr std::array<std::string_view, 4> kSigned = {"int8_t", "int16_t", "int32_t",
                                                       "int64_t"};
  constexpr std::array<std::string_view, 4> kUnsigned = {"uint8_t", "uint16_t",
                                                         "uint32_t", "uint64_t"};
  const std::size_t at = std::bit_width(sizeof(Item)) - 1U;
  return std::is_signed_v<Item> ? kSigned[at] : kUnsigned[at];
}

/// Visits the fields of a message in the order of its definition.
template <Message T>
void visit_fields(T& message, FieldVisitor& visitor) {
  std::size_t at = 0;
  for_each_field<T>([&]<class M, class F>(const Field<T, M, F>& field) {
    using Item = typename detail::Element<M>::type;
    constexpr bool kArray = type_traits::kIsArray<M>;
    visitor.visit({field.name, type_name<Item>(), sizeof(Item),
                   kArray ? sizeof(M) / sizeof(Item) : 0, at++ >= kFacts<T>.base_fields,
                   &(message.*field.member)});
  });
}

/// A pseudo-random number that a text stands for: FNV-1a, its bits mixed.
inline std::uint32_t draw(std::string_view text) {
  std::uint32_t hash = 2'166'136'261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16'777'619U;
  hash = (hash ^ hash >> 16) * 0x85eb'ca6bU;
  hash = (hash ^ hash >> 13) * 0xc2b2'ae35U;
  return hash ^ hash >> 16;
}

/// What a field holds in a round of a kind of message.
class AgreedValues {
 public:
  AgreedValues(std::uint32_t id, int round) : id_(id), round_(round) {}

  /// The bits of an element.
  std::uint64_t bits(const AnyField& field, std::size_t index) const {
    if (field.type == "char") return character(field, index);
    const bool real = field.type == "float";
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - 8 * field.width);
    const bool has_sign = field.type.front() == 'i';
    switch (style()) {
      case kZero:
        return 0;
      case kGreatest:
        return real ? 0x7f80'0000U : has_sign ? all >> 1 : all;
      case kLowest:
        return real ? 0xff7f'ffffU : has_sign ? all - (all >> 1) : 0;
      case kNan:
        if (real) return 0x7fc0'0000U | (drawn(field, index, "lo") & 0x803f'ffffU);
        break;
      case kSparse:
        if (drawn(field, index, "zero") % 2 == 0) return 0;
        break;
      default:
        break;
    }
    const std::uint64_t high = drawn(field, index, "hi");
    return (high << 32 | drawn(field, index, "lo")) & all;
  }

 private:
  enum Style : std::uint8_t { kZero, kGreatest, kLowest, kNan, kSparse, kRandom };

  Style style() const { return static_cast<Style>(round_ % 6); }
  std::uint32_t drawn(const AnyField& field, std::size_t index, const char* what) const {
    return draw(fmt::format("{}.{}.{}.{}.{}", id_, round_, field.name, index, what));
  }
  std::uint64_t character(const AnyField& field, std::size_t index) const {
    if (style() == kZero || style() == kLowest) return 0;
    if (style() == kGreatest) return 'Z';
    const std::size_t length = drawn(field, 0, "length") % (field.elements() + 1);
    return index < length ? 1 + drawn(field, index, "lo") % 255 : 0;
  }

  std::uint32_t id_;
  int round_;
};

}  // namespace skein::mavlink
