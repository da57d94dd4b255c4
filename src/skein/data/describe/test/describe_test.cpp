// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "skein/data/describe/columns.h"
#include "skein/data/event/record.h"

namespace skein::describe_test {
namespace {

using namespace type_traits;  // NOLINT: the traits are ours

// Random values of any described type: every field, every alternative.
class Drawer {
 public:
  explicit Drawer(unsigned seed) : engine_(seed) {}

  template <class T>
  T draw() {
    T value{};
    fill(value);
    return value;
  }

 private:
  std::size_t below(std::size_t n) { return engine_() % n; }

  template <class T>
  void fill(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = below(2) == 1;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = std::uniform_real_distribution<T>(-1, 1)(engine_);
    } else if constexpr (std::is_same_v<T, Time>) {
      value = Time::from_ns(static_cast<std::int64_t>(engine_() % 1'000'000'000'000));
    } else if constexpr (std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>) {
      for (double& c : value) fill(c);
    } else if constexpr (std::is_same_v<T, Quat>) {
      for (double& c : value.coeffs()) fill(c);
      value.normalize();
    } else if constexpr (NamedEnum<T>) {
      value = static_cast<T>(below(names_of(static_cast<const T*>(nullptr)).size()));
    } else if constexpr (WrittenAsName<T>) {
      value = T::named("name-" + std::to_string(below(1000)));
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "text " + std::to_string(below(1000)) + " \xC3\xA9";
    } else if constexpr (kIsId<T>) {
      value.value = static_cast<std::uint32_t>(engine_());
    } else if constexpr (std::is_integral_v<T>) {
      value = static_cast<T>(engine_() >> below(63));
    } else if constexpr (kIsOptional<T>) {
      if (below(2) == 1) fill(value.emplace());
    } else if constexpr (kIsVector<T>) {
      value.resize(below(5));
      for (auto& item : value) fill(item);
    } else if constexpr (kIsArray<T>) {
      for (auto& item : value) fill(item);
    } else if constexpr (kIsVariant<T>) {
      fill_choice(value);
    } else {
      for_each_field<T>([&](const auto& f) { fill(value.*f.member); });
    }
  }

  template <class... Ts>
  void fill_choice(std::variant<Ts...>& value) {
    const std::size_t which = below(sizeof...(Ts));
    std::size_t at = 0;
    ((at++ == which ? fill(value.template emplace<Ts>()) : void()), ...);
  }

  std::mt19937_64 engine_;
};

template <class T>
std::vector<std::byte> canonical(const T& value) {
  std::vector<std::byte> bytes;
  wire::encode_canonical(value, bytes);
  return bytes;
}

constexpr const Record* kRecords = nullptr;

TEST(Wire, EveryKindComesBackAsItWas) {
  Drawer drawer(11);
  for (int i = 0; i < 3000; ++i) {
    const Record record = drawer.draw<Record>();
    std::vector<std::byte> coded;
    wire::encode(record, coded);
    EXPECT_EQ(coded.size(), wire::coded_size(record));
    const auto decoded = wire::decode<Record>(coded);
    ASSERT_TRUE(decoded.ok()) << decoded.error().text();
    EXPECT_EQ(canonical(decoded.value()), canonical(record));
  }
}

TEST(Wire, BytesThatEndTooEarlyAreAnError) {
  Drawer drawer(12);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> coded;
    wire::encode(drawer.draw<Record>(), coded);
    for (std::size_t cut = 0; cut < coded.size(); ++cut)
      EXPECT_FALSE(wire::decode<Record>(std::span(coded).first(cut)).ok());
    coded.push_back(std::byte{0});
    EXPECT_FALSE(wire::decode<Record>(coded).ok());
  }
}

TEST(Wire, AnyBytesAreAValueOrAnError) {
  Drawer drawer(13);
  std::mt19937_64 engine(14);
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> coded;
    wire::encode(drawer.draw<Record>(), coded);
    for (int k = 0; k < 3; ++k)
      coded[engine() % coded.size()] = static_cast<std::byte>(engine());
    const auto decoded = wire::decode<Record>(coded);
    if (!decoded) continue;
    std::vector<std::byte> again;
    wire::encode(decoded.value(), again);
    EXPECT_TRUE(wire::decode<Record>(again).ok());
  }
}

// What a sender of an older and of a newer version calls a position.
struct OldPosition {
  double north = 0;
};
constexpr auto describe(const OldPosition*) {
  return described<OldPosition>({"position"}, "",
                                field("north", &OldPosition::north, ""));
}
struct NewPosition {
  double north = 0;
  double east = 7;
  std::string name = "unnamed";
};
constexpr auto describe(const NewPosition*) {
  using T = NewPosition;
  return described<T>({"position"}, "", field("north", &T::north, ""),
                      field("east", &T::east, ""), field("name", &T::name, ""));
}
template <class T>
struct Two {
  T first, second;
};
template <class T>
constexpr auto describe(const Two<T>*) {
  return described<Two<T>>({"two"}, "", field("first", &Two<T>::first, ""),
                           field("second", &Two<T>::second, ""));
}

TEST(Wire, FieldsThatOneSideDoesNotKnowArePassedOver) {
  std::vector<std::byte> coded;
  wire::encode(Two<NewPosition>{{1, 2, "a"}, {3, 4, "b"}}, coded);
  const auto fewer = wire::decode<Two<OldPosition>>(coded);
  ASSERT_TRUE(fewer.ok());
  EXPECT_EQ(fewer.value().first.north, 1);
  EXPECT_EQ(fewer.value().second.north, 3);

  coded.clear();
  wire::encode(Two<OldPosition>{{1}, {3}}, coded);
  const auto more = wire::decode<Two<NewPosition>>(coded);
  ASSERT_TRUE(more.ok());
  EXPECT_EQ(more.value().second.north, 3);
  EXPECT_EQ(more.value().second.east, 7);
  EXPECT_EQ(more.value().second.name, "unnamed");
}

TEST(Wire, AnotherVersionIsRefused) {
  std::vector<std::byte> coded;
  wire::encode(Record(Event{}), coded);
  coded[0] = std::byte{wire::kVersion + 1};
  EXPECT_FALSE(wire::decode<Record>(coded).ok());
}

TEST(Canonical, EqualNumbersGiveEqualBytes) {
  Crossing a, b;
  a.point_sd = 0.0;
  b.point_sd = -0.0;
  EXPECT_EQ(canonical(a), canonical(b));
  a.point_sd = std::numeric_limits<double>::quiet_NaN();
  b.point_sd = -std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(canonical(a), canonical(b));
}

// Each number of each value counts: today's and tomorrow's fields.
template <class T>
void expect_every_field_counts(Drawer& drawer) {
  const T value = drawer.draw<T>();
  for_each_field<T>([&](const auto& f) {
    if (!f.hashed) return;
    bool counts = false;
    for (int attempt = 0; attempt < 40 && !counts; ++attempt) {
      T other = value;
      other.*f.member = drawer.draw<T>().*f.member;
      counts = canonical(other) != canonical(value);
    }
    EXPECT_TRUE(counts) << kind_of<T>() << "." << f.name;
  });
}

TEST(Canonical, EveryFieldOfEveryKindCounts) {
  Drawer drawer(15);
  for_each_alternative(kRecords,
                       [&]<class T>() { expect_every_field_counts<T>(drawer); });
  for_each_alternative(static_cast<const TaskKind*>(nullptr),
                       [&]<class T>() { expect_every_field_counts<T>(drawer); });
  expect_every_field_counts<BoundaryPoint>(drawer);
}

TEST(Json, EveryKindComesBackAsItWas) {
  Drawer drawer(16);
  for (int i = 0; i < 50; ++i)
    for_each_alternative(kRecords, [&]<class T>() {
      const T value = drawer.draw<T>();
      const json::Json written = json::to_json(value);
      const auto read = json::from_json<T>(json::Json::parse(written.dump()));
      ASSERT_TRUE(read.ok()) << read.error().text() << written.dump(1);
      // Degrees and Euler angles cost the last digits, so what is compared is what was
      // written, to its twelfth digit.
      const json::Json again = json::to_json(read.value());
      ASSERT_EQ(again.size(), written.size());
      for (const auto& [key, one] : written.items()) {
        if (one.is_number_float())
          EXPECT_NEAR(again[key].template get<double>(), one.template get<double>(), 1e-9)
              << key;
        else if (!one.is_structured())
          EXPECT_EQ(again[key], one) << key;
        else
          EXPECT_EQ(again[key].size(), one.size()) << key;
      }
    });
}

TEST(Json, AVectorThatMayBeMissingComesBack) {
  LandRequest request;
  request.point = Vec2(3, -4);
  const auto read = json::from_json<LandRequest>(json::to_json(request));
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read.value().point, request.point);
  const auto nowhere = json::from_json<LandRequest>(json::to_json(LandRequest()));
  ASSERT_TRUE(nowhere.ok());
  EXPECT_FALSE(nowhere.value().point);
}

TEST(Json, AValueThatIsMissingStaysSoBesideNamesThatBeginAsItsOwn) {
  RemoteState state;
  state.truth_time = Time::from_seconds(3);
  const auto read = json::from_json<RemoteState>(json::to_json(state));
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_FALSE(read.value().truth);
  EXPECT_EQ(read.value().truth_time, state.truth_time);
}

TEST(Json, WhatIsWrongIsNamed) {
  const auto read =
      json::from_json<Crossing>(json::Json::parse(R"({"time_s": 1, "north_m": "far"})"));
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().text().find("north_m"), std::string::npos);
  const auto unknown = json::from_json<TaskCommand>(
      json::Json::parse(R"({"aircraft": "a", "what": {"kind": "juggle"}})"));
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.error().text().find("what"), std::string::npos);
}

struct Counter {
  std::size_t count = 0;
  template <class V>
  void put(V&& /*value*/) {
    ++count;
  }
};

TEST(Columns, AreAsManyAsTheValuesOfARow) {
  Drawer drawer(17);
  for_each_alternative(kRecords, [&]<class T>() {
    Counter counter;
    columns::put(drawer.draw<T>(), counter);
    EXPECT_EQ(counter.count, columns::columns_of<T>().size()) << kind_of<T>();
  });
}

TEST(Columns, NamesAreUniqueAndSayTheirUnit) {
  for_each_alternative(kRecords, []<class T>() {
    std::vector<std::string> names;
    for (const columns::Column& column : columns::columns_of<T>())
      names.push_back(column.name);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end())
        << kind_of<T>();
  });
  const auto crossing = columns::columns_of<Crossing>();
  EXPECT_EQ(crossing[0].name, "time_s");
  EXPECT_EQ(crossing[2].name, "north_m");
  EXPECT_EQ(crossing[6].name, "track_north_m");
}

}  // namespace
}  // namespace skein::describe_test
