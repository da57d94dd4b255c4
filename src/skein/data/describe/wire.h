// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/base/valid_text.h"
#include "skein/data/describe/describe.h"
#include "skein/data/describe/type_traits.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

/// The binary form in which described values travel: docs/wire.md.
///
///   struct    length, then its fields in order; a reader that knows fewer passes over
///             the rest, one that knows more keeps its defaults
///   choice    number of the alternative, then the alternative with its length
///   integer   LEB128, signed ones in zigzag; Time and floating-point numbers as they
///             are, little-endian; text and lists with their count before them
///
/// A coded value begins with a byte that says the version of these rules.
namespace skein::wire {

inline constexpr std::uint8_t kVersion = 1;

static_assert(std::endian::native == std::endian::little,
              "numbers are copied as they lie in memory");

namespace detail {

using namespace type_traits;  // NOLINT: the traits are ours

constexpr std::size_t varint_size(std::uint64_t value) {
  return (static_cast<std::size_t>(std::bit_width(value | 1)) + 6) / 7;
}
constexpr std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^
         static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

template <Described T>
constexpr std::size_t fixed_fields_size();

// Bytes of a value that are the same for all values of its type; 0 = they differ.
template <class T>
constexpr std::size_t fixed_size() {
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> ||
                std::is_same_v<T, std::uint8_t>) {
    return 1;
  } else if constexpr (std::is_same_v<T, float>) {
    return 4;
  } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Time>) {
    return 8;
  } else if constexpr (std::is_same_v<T, Vec2>) {
    return 16;
  } else if constexpr (std::is_same_v<T, Vec3>) {
    return 24;
  } else if constexpr (std::is_same_v<T, Quat>) {
    return 32;
  } else if constexpr (kIsArray<T>) {
    return std::tuple_size_v<T> * fixed_size<typename T::value_type>();
  } else if constexpr (Described<T>) {
    constexpr std::size_t kFields = fixed_fields_size<T>();
    return kFields > 0 ? varint_size(kFields) + kFields : 0;
  } else {
    return 0;
  }
}

// The same of the fields of a struct, without its length.
template <Described T>
constexpr std::size_t fixed_fields_size() {
  std::size_t sum = 0;
  bool fixed = true;
  for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
    sum += fixed_size<M>();
    fixed = fixed && f.hashed && fixed_size<M>() > 0;
  });
  return fixed ? sum : 0;
}

// Bytes of the fields of a struct, without its length; Canonical: of those that are
// hashed.
template <bool Canonical, Described T>
std::size_t fields_size(const T& value);

template <bool Canonical, class T>
std::size_t bytes_of(const T& value) {
  if constexpr (fixed_size<T>() > 0) {
    return fixed_size<T>();
  } else if constexpr (Described<T>) {
    const std::size_t inner = fields_size<Canonical>(value);
    return inner + varint_size(inner);
  } else if constexpr (kIsId<T>) {
    return varint_size(value.value);
  } else if constexpr (std::is_unsigned_v<T>) {
    return varint_size(value);
  } else if constexpr (std::is_integral_v<T>) {
    return varint_size(zigzag(value));
  } else if constexpr (std::is_same_v<T, std::string>) {
    return varint_size(value.size()) + value.size();
  } else if constexpr (WrittenAsName<T>) {
    return varint_size(value.name().size()) + value.name().size();
  } else if constexpr (kIsOptional<T>) {
    return 1 + (value ? bytes_of<Canonical>(*value) : 0);
  } else if constexpr (kIsVector<T>) {
    using Item = typename T::value_type;
    std::size_t sum = varint_size(value.size());
    if constexpr (fixed_size<Item>() > 0)
      sum += value.size() * fixed_size<Item>();
    else
      for (const Item& item : value) sum += bytes_of<Canonical>(item);
    return sum;
  } else if constexpr (kIsArray<T>) {
    std::size_t sum = 0;
    for (const auto& item : value) sum += bytes_of<Canonical>(item);
    return sum;
  } else {
    static_assert(kIsVariant<T>, "this type has no wire form");
    return std::visit(
        [&](const auto& chosen) {
          const std::size_t inner = bytes_of<Canonical>(chosen);
          return varint_size(value.index()) + varint_size(inner) + inner;
        },
        value);
  }
}

template <bool Canonical, Described T>
std::size_t fields_size(const T& value) {
  std::size_t sum = 0;
  for_each_field<T>([&](const auto& f) {
    if (!Canonical || f.hashed) sum += bytes_of<Canonical>(value.*f.member);
  });
  return sum;
}

/// Writes into memory that is known to be large enough.
///
/// @tparam Canonical  numbers that are equal give equal bytes: -0 is written as 0, and
///                    every NaN as the same one; fields that are not hashed are left out.
template <bool Canonical>
class Writer {
 public:
  explicit Writer(std::byte* to) : to_(to) {}
  const std::byte* end() const { return to_; }

  template <class T>
  void put(const T& value) {
    if constexpr (std::is_same_v<T, double>) {
      put_number(value);
    } else if constexpr (std::is_same_v<T, float>) {
      put_raw(value);
    } else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> ||
                         std::is_same_v<T, std::uint8_t>) {
      *to_++ = static_cast<std::byte>(value);
    } else if constexpr (std::is_same_v<T, Time>) {
      put_raw(value.ns());
    } else if constexpr (std::is_same_v<T, Quat>) {
      for (const double c : {value.w(), value.x(), value.y(), value.z()}) put_number(c);
    } else if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
      for (const double c : value) put_number(c);
    } else if constexpr (Described<T>) {
      put_struct(value);
    } else {
      put_composed(value);
    }
  }

 private:
  template <Described T>
  void put_struct(const T& value) {
    if constexpr (fixed_size<T>() > 0)
      put_varint(fixed_fields_size<T>());
    else
      put_varint(fields_size<Canonical>(value));
    for_each_field<T>([&](const auto& f) {
      if (!Canonical || f.hashed) put(value.*f.member);
    });
  }

  template <class T>
  void put_composed(const T& value) {
    if constexpr (kIsId<T>) {
      put_varint(value.value);
    } else if constexpr (std::is_unsigned_v<T>) {
      put_varint(value);
    } else if constexpr (std::is_integral_v<T>) {
      put_varint(zigzag(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      put_text(value);
    } else if constexpr (WrittenAsName<T>) {
      put_text(value.name());
    } else if constexpr (kIsOptional<T>) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (kIsVariant<T>) {
      put_varint(value.index());
      std::visit(
          [&](const auto& chosen) {
            put_varint(bytes_of<Canonical>(chosen));
            put(chosen);
          },
          value);
    } else {
      if constexpr (kIsVector<T>) put_varint(value.size());
      for (const auto& item : value) put(item);
    }
  }

  void put_text(std::string_view text) {
    put_varint(text.size());
    std::memcpy(to_, text.data(), text.size());
    to_ += text.size();
  }
  void put_varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) *to_++ = static_cast<std::byte>(value | 0x80);
    *to_++ = static_cast<std::byte>(value);
  }
  void put_number(double value) {
    if constexpr (Canonical)
      value = value == value ? value + 0.0 : std::numeric_limits<double>::quiet_NaN();
    put_raw(value);
  }
  template <class Raw>
  void put_raw(Raw raw) {
    std::memcpy(to_, &raw, sizeof raw);
    to_ += sizeof raw;
  }

  std::byte* to_;
};

/// Reads from any bytes; after the first that make no sense everything fails.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool done() const { return bytes_.empty(); }
  /// What was wrong; empty while nothing was.
  const char* wrong() const { return wrong_; }

  template <class T>
  bool get(T& value) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, float> ||
                  std::is_same_v<T, std::uint8_t>) {
      return get_raw(value);
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t raw = 0;
      if (!get_raw(raw)) return false;
      value = raw == 1;
      return raw <= 1 || fail("a flag is neither 0 nor 1");
    } else if constexpr (NamedEnum<T>) {
      std::uint8_t raw = 0;
      if (!get_raw(raw)) return false;
      value = static_cast<T>(raw);
      return raw < names_of(static_cast<const T*>(nullptr)).size() ||
             fail("an enumeration has no such value");
    } else if constexpr (std::is_same_v<T, Time>) {
      std::int64_t ns = 0;
      if (!get_raw(ns)) return false;
      value = Time::from_ns(ns);
      return true;
    } else if constexpr (std::is_same_v<T, Quat>) {
      return get(value.w()) && get(value.x()) && get(value.y()) && get(value.z());
    } else if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
      for (double& c : value)
        if (!get_raw(c)) return false;
      return true;
    } else if constexpr (Described<T>) {
      return get_struct(value);
    } else {
      return get_composed(value);
    }
  }

 private:
  template <Described T>
  bool get_struct(T& value) {
    Reader inner({});
    if (!get_part(inner)) return false;
    bool good = true;
    for_each_field<T>([&](const auto& f) {
      // An older sender: this field and all after it keep their defaults.
      if (good && !inner.done()) good = inner.get(value.*f.member);
    });
    return good || fail(inner.wrong_);
  }

  template <class T>
  bool get_composed(T& value) {
    if constexpr (kIsId<T>) {
      return get_unsigned(value.value);
    } else if constexpr (std::is_unsigned_v<T>) {
      return get_unsigned(value);
    } else if constexpr (std::is_integral_v<T>) {
      std::uint64_t raw = 0;
      if (!get_varint(raw)) return false;
      const std::int64_t wide = unzigzag(raw);
      value = static_cast<T>(wide);
      return value == wide || fail("an integer is too large");
    } else if constexpr (std::is_same_v<T, std::string>) {
      return get_text(value);
    } else if constexpr (WrittenAsName<T>) {
      std::string name;
      if (!get_text(name)) return false;
      value = T::named(name);
      return true;
    } else if constexpr (kIsOptional<T>) {
      bool has = false;
      if (!get(has)) return false;
      value.reset();
      return !has || get(value.emplace());
    } else if constexpr (kIsVector<T>) {
      return get_list(value);
    } else if constexpr (kIsArray<T>) {
      for (auto& item : value)
        if (!get(item)) return false;
      return true;
    } else {
      static_assert(kIsVariant<T>, "this type has no wire form");
      return get_choice(value);
    }
  }

  bool get_text(std::string& text) {
    Reader inner({});
    if (!get_part(inner)) return false;
    text = valid_text(std::string_view(reinterpret_cast<const char*>(inner.bytes_.data()),
                                       inner.bytes_.size()));
    return true;
  }
  template <class T>
  bool get_list(T& list) {
    std::uint64_t count = 0;
    if (!get_varint(count)) return false;
    // Every item takes a byte at least: a count cannot ask for more memory than that.
    if (count > bytes_.size()) return fail("a list is longer than what is there");
    list.clear();
    list.reserve(static_cast<std::size_t>(count));
    for (std::uint64_t i = 0; i < count; ++i)
      if (!get(list.emplace_back())) return false;
    return true;
  }

  template <class... Ts>
  bool get_choice(std::variant<Ts...>& value) {
    std::uint64_t index = 0;
    Reader inner({});
    if (!get_varint(index) || !get_part(inner)) return false;
    if (index >= sizeof...(Ts)) return fail("a kind is not known to this version");
    bool good = false;
    std::uint64_t at = 0;
    ((at++ == index ? void(good = inner.get(value.template emplace<Ts>())) : void()),
     ...);
    return good || fail(inner.wrong_);
  }

  template <class Unsigned>
  bool get_unsigned(Unsigned& value) {
    std::uint64_t wide = 0;
    if (!get_varint(wide)) return false;
    value = static_cast<Unsigned>(wide);
    return value == wide || fail("an integer is too large");
  }

  bool get_varint(std::uint64_t& value);
  bool get_part(Reader& part);
  bool fail(const char* what) {
    if (!wrong_) wrong_ = what;
    bytes_ = {};
    return false;
  }
  template <class Raw>
  bool get_raw(Raw& raw) {
    if (bytes_.size() < sizeof raw) return fail("it ends too early");
    std::memcpy(&raw, bytes_.data(), sizeof raw);
    bytes_ = bytes_.subspan(sizeof raw);
    return true;
  }

  std::span<const std::byte> bytes_;
  const char* wrong_ = nullptr;
};

}  // namespace detail

/// The bytes that encode() needs for a value.
template <class T>
std::size_t coded_size(const T& value) {
  return 1 + detail::bytes_of<false>(value);
}

/// Appends the coded value to `out`, whose memory may be used again and again.
template <class T>
void encode(const T& value, std::vector<std::byte>& out) {
  const std::size_t before = out.size();
  out.resize(before + coded_size(value));
  out[before] = std::byte{kVersion};
  detail::Writer<false> writer(out.data() + before + 1);
  writer.put(value);
}

/// Replaces `out` by bytes that are equal for equal values: what a content hash is of.
template <class T>
void encode_canonical(const T& value, std::vector<std::byte>& out) {
  out.resize(detail::bytes_of<true>(value));
  detail::Writer<true> writer(out.data());
  writer.put(value);
}

/// The error of bytes that are no coded value.
Error bad_bytes(const char* wrong);

/// The value that was coded.
/// Fails: kBadInput for bytes that are of another version, end too early or make no
///        sense.
template <class T>
Result<T> decode(std::span<const std::byte> bytes) {
  if (bytes.empty()) return bad_bytes("it ends too early");
  if (bytes.front() != std::byte{kVersion})
    return bad_bytes("it is of another version of the wire form");
  detail::Reader reader(bytes.subspan(1));
  T value;
  if (!reader.get(value)) return bad_bytes(reader.wrong());
  if (!reader.done()) return bad_bytes("there are bytes after the value");
  return value;
}

}  // namespace skein::wire
