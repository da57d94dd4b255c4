// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/mission_service.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <optional>

#include "skein/link/vehicle_services/places.h"
#include "skein/link/vehicle_services/test/bad_line.h"

namespace skein::vehicle_services::mission_service_test {
namespace {

using mavlink::MissionResult;
using Item = MissionService::Item;

std::vector<Item> mission(int count) {
  std::vector<Item> items;
  for (int k = 0; k < count; ++k) {
    Item item;
    item.seq = static_cast<std::uint16_t>(k);
    item.command = 16;
    item.frame = 6;
    item.x = 470'000'000 + 1000 * k;
    item.y = 80'000'000;
    item.z = 80;
    items.push_back(item);
  }
  return items;
}

// Refuses a list with an item that is below 0.
MissionResult check(const std::vector<Item>& items) {
  for (const Item& item : items)
    if (item.z < 0) return MissionResult::kInvalidZ;
  return MissionResult::kAccepted;
}

struct Vehicle {
  explicit Vehicle(MissionService::Options options = {}) : service(options, check) {}

  void handle(const mavlink::Frame& frame, Time now, Outbox& out) {
    const Peer from = peer_of(frame);
    on<mavlink::MissionCount>(frame,
                              [&](const auto& m) { service.handle(m, from, now, out); });
    on<Item>(frame, [&](const auto& m) { service.handle(m, from, now, out); });
    on<mavlink::MissionRequestList>(frame,
                                    [&](const auto& m) { service.handle(m, from, out); });
    on<mavlink::MissionRequestInt>(frame,
                                   [&](const auto& m) { service.handle(m, from, out); });
    on<mavlink::MissionItem>(
        frame, [&](const auto& m) { service.handle(with_integers(m), from, now, out); });
    on<mavlink::MissionRequest>(frame,
                                [&](const auto& m) { service.handle(m, from, out); });
  }

  MissionService service;
};

// The ground station's part of an upload: items on request; the count again after 1.5 s
// without any, the last item again after 1.5 s without an answer.
struct Uploader {
  std::vector<Item> items;
  std::optional<int> result;
  int acks = 0;
  bool asked = false;
  Time spoke;

  void begin(BadLine& line) {
    mavlink::MissionCount count;
    count.count = static_cast<std::uint16_t>(items.size());
    line.station.send(1, count);
    spoke = line.now;
  }
  void hear(const mavlink::Frame& frame, BadLine& line) {
    on<mavlink::MissionRequestInt>(frame, [&](const auto& m) {
      EXPECT_EQ(m.target_system, 255);
      EXPECT_EQ(m.target_component, 190);
      ASSERT_LT(m.seq, items.size());
      line.station.send(1, items[m.seq]);
      asked = true;
      spoke = line.now;
    });
    on<mavlink::MissionAck>(frame, [&](const auto& m) {
      result = m.type;
      ++acks;
    });
  }
  void step(BadLine& line) {
    if (result || line.now - spoke < Time::from_seconds(1.5)) return;
    if (!asked) return begin(line);
    line.station.send(1, items.back());
    spoke = line.now;
  }
};

std::optional<int> upload(BadLine& line, Vehicle& vehicle,
                          const std::vector<Item>& items) {
  Uploader uploader;
  uploader.items = items;
  line.at_vehicle = [&](const auto& f) { vehicle.handle(f, line.now, line.vehicle); };
  line.at_station = [&](const auto& f) { uploader.hear(f, line); };
  uploader.begin(line);
  for (int k = 0; k < 60'000 && !uploader.result; ++k) {
    line.step();
    vehicle.service.step(line.now, line.vehicle);
    uploader.step(line);
  }
  return uploader.result;
}

std::vector<Item> download(BadLine& line, Vehicle& vehicle) {
  std::optional<std::size_t> count;
  std::map<int, Item> items;
  line.at_vehicle = [&](const auto& f) { vehicle.handle(f, line.now, line.vehicle); };
  line.at_station = [&](const mavlink::Frame& frame) {
    on<mavlink::MissionCount>(frame, [&](const auto& m) { count = m.count; });
    on<Item>(frame, [&](const auto& m) { items[m.seq] = m; });
  };
  for (int k = 0; k < 60'000 && (!count || items.size() < *count); ++k) {
    if (k % 120 == 0 && !count) line.station.send(1, mavlink::MissionRequestList());
    if (k % 120 == 60 && count)
      for (std::size_t i = 0, asked = 0; i < *count && asked < 5; ++i)
        if (!items.contains(int(i))) {
          mavlink::MissionRequestInt request;
          request.seq = static_cast<std::uint16_t>(i);
          line.station.send(1, request);
          ++asked;
        }
    line.step();
  }
  std::vector<Item> list;
  for (auto& [seq, item] : items) list.push_back(item);
  return list;
}

TEST(MissionService, LoadsUpAndDownOverEveryLine) {
  for (const Trouble& trouble : troubles()) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "loss " << trouble.loss << " seed " << seed);
      BadLine line(trouble, seed);
      Vehicle vehicle;
      const auto items = mission(30);
      ASSERT_EQ(upload(line, vehicle, items), 0);
      ASSERT_EQ(vehicle.service.items().size(), 30U);
      for (std::size_t i = 0; i < items.size(); ++i)
        EXPECT_EQ(vehicle.service.items()[i].x, items[i].x);
      EXPECT_EQ(vehicle.service.version(), 1U);
      const auto back = download(line, vehicle);
      ASSERT_EQ(back.size(), 30U);
      for (std::size_t i = 0; i < items.size(); ++i) EXPECT_EQ(back[i].x, items[i].x);
    }
  }
}

TEST(MissionService, KeepsTheOldListUntilTheNewOneIsThereAndGood) {
  BadLine line({}, 1);
  Vehicle vehicle;
  ASSERT_EQ(upload(line, vehicle, mission(4)), 0);
  auto bad = mission(9);
  bad[7].z = -5;
  EXPECT_EQ(upload(line, vehicle, bad), int(MissionResult::kInvalidZ));
  EXPECT_EQ(vehicle.service.items().size(), 4U);
  EXPECT_EQ(vehicle.service.version(), 1U);
  // Begun and never finished.
  mavlink::MissionCount count;
  count.count = 6;
  std::optional<int> result;
  line.at_station = [&](const mavlink::Frame& frame) {
    on<mavlink::MissionAck>(frame, [&](const auto& m) { result = m.type; });
  };
  line.station.send(1, count);
  for (int k = 0; k < 1100; ++k) {
    line.step();
    vehicle.service.step(line.now, line.vehicle);
    if (k == 500) {
      EXPECT_TRUE(vehicle.service.busy());
    }
  }
  EXPECT_EQ(result, int(MissionResult::kCancelled));
  EXPECT_FALSE(vehicle.service.busy());
  EXPECT_EQ(vehicle.service.items().size(), 4U);
}

TEST(MissionService, TakesOneUploadAtATime) {
  Vehicle vehicle;
  std::map<Channel, int> acks;
  Outbox out(7, 1, [&](Channel channel, std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::MissionAck>(frame, [&](const auto& m) { acks[channel] = m.type; });
    });
  });
  mavlink::MissionCount count;
  count.count = 3;
  vehicle.service.handle(count, {1, 255, 190}, Time(), out);
  vehicle.service.handle(count, {2, 254, 190}, Time(), out);
  EXPECT_EQ(acks, (std::map<Channel, int>{{2, int(MissionResult::kDenied)}}));
  count.count = 3000;
  vehicle.service.handle(count, {1, 255, 190}, Time(), out);
  EXPECT_EQ(acks.at(1), int(MissionResult::kNoSpace));
}

TEST(MissionService, AnswersAgainWhenItsAnswerWasLost) {
  Vehicle vehicle;
  int acks = 0;
  Outbox out(7, 1, [&](Channel, std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::MissionAck>(frame, [&](const auto&) { ++acks; });
    });
  });
  const Peer station{1, 255, 190};
  mavlink::MissionCount count;
  count.count = 1;
  vehicle.service.handle(count, station, Time(), out);
  for (int k = 0; k < 3; ++k) vehicle.service.handle(mission(1)[0], station, Time(), out);
  EXPECT_EQ(acks, 3);
  EXPECT_EQ(vehicle.service.version(), 1U);
}

TEST(MissionService, HomeComesFirstWhereTheIdentityAsks) {
  BadLine line({}, 1);
  Vehicle vehicle({mavlink::MissionType::kMission, 100, true});
  Item home;
  home.x = 123;
  vehicle.service.set_home(home);
  ASSERT_EQ(upload(line, vehicle, mission(4)), 0);
  ASSERT_EQ(vehicle.service.items().size(), 3U);
  EXPECT_EQ(vehicle.service.items()[0].x, mission(4)[1].x);
  const auto back = download(line, vehicle);
  ASSERT_EQ(back.size(), 4U);
  EXPECT_EQ(back[0].x, 123);
  EXPECT_EQ(back[1].x, mission(4)[1].x);
}

TEST(MissionService, IsClearedByAnEmptyListToo) {
  BadLine line({}, 1);
  Vehicle vehicle;
  ASSERT_EQ(upload(line, vehicle, mission(4)), 0);
  EXPECT_EQ(upload(line, vehicle, {}), 0);
  EXPECT_TRUE(vehicle.service.items().empty());
}

TEST(MissionService, SpeaksWithFloatsToo) {
  Vehicle vehicle;
  std::optional<mavlink::MissionItem> given;
  std::optional<int> result;
  Outbox out(7, 1, [&](Channel, std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::MissionItem>(frame, [&](const auto& m) { given = m; });
      on<mavlink::MissionAck>(frame, [&](const auto& m) { result = m.type; });
    });
  });
  const Peer station{1, 255, 190};
  mavlink::MissionCount count;
  count.count = 1;
  vehicle.service.handle(count, station, Time(), out);
  mavlink::MissionItem item = with_floats(mission(1)[0]);
  EXPECT_FLOAT_EQ(item.x, 47);
  vehicle.service.handle(with_integers(item), station, Time(), out);
  EXPECT_EQ(result, 0);
  EXPECT_NEAR(vehicle.service.items()[0].x, 470'000'000, 20);  // 1e-6 of a degree
  mavlink::MissionRequest request;
  vehicle.service.handle(request, station, out);
  ASSERT_TRUE(given);
  EXPECT_FLOAT_EQ(given->x, 47);
  EXPECT_FLOAT_EQ(given->y, 8);
  EXPECT_EQ(given->target_system, 255);
}

TEST(MissionService, FloatsThatAreNoPlaceSayThatThereIsNone) {
  mavlink::MissionItem item;
  item.frame = 6;
  item.x = std::numeric_limits<float>::quiet_NaN();
  item.y = std::numeric_limits<float>::infinity();
  EXPECT_EQ(with_integers(item).x, kNoCoordinate);
  EXPECT_EQ(with_integers(item).y, kNoCoordinate);
  item.x = 1e30F;
  EXPECT_NE(with_integers(item).x, kNoCoordinate);
  item.frame = 2;
  item.x = 12;
  EXPECT_EQ(with_integers(item).x, 12) << "no place: no degrees";
}

TEST(MissionService, IsClearedUnlessAnotherUploads) {
  BadLine line({}, 1);
  Vehicle vehicle;
  ASSERT_EQ(upload(line, vehicle, mission(4)), 0);
  mavlink::MissionCount count;
  count.count = 3;
  vehicle.service.handle(count, {1, 255, 190}, line.now, line.vehicle);
  EXPECT_EQ(vehicle.service.clear({2, 254, 190}), MissionResult::kDenied);
  EXPECT_EQ(vehicle.service.items().size(), 4U);
  EXPECT_EQ(vehicle.service.clear({1, 255, 190}), MissionResult::kAccepted);
  EXPECT_TRUE(vehicle.service.items().empty());
  EXPECT_FALSE(vehicle.service.busy());
}

TEST(MissionService, ForgetsAnUploadWithItsLink) {
  BadLine line({}, 1);
  Vehicle vehicle;
  mavlink::MissionCount count;
  count.count = 3;
  vehicle.service.handle(count, {4, 255, 190}, line.now, line.vehicle);
  vehicle.service.close(3);
  EXPECT_TRUE(vehicle.service.busy());
  vehicle.service.close(4);
  EXPECT_FALSE(vehicle.service.busy());
}

TEST(MissionService, AStationGoesOnOverAnotherLink) {
  Vehicle vehicle;
  std::map<Channel, int> requests;
  Outbox out(7, 1, [&](Channel channel, std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::MissionRequestInt>(frame, [&](const auto&) { ++requests[channel]; });
    });
  });
  mavlink::MissionCount count;
  count.count = 3;
  vehicle.service.handle(count, {4, 255, 190}, Time(), out);
  vehicle.service.handle(mission(1)[0], {5, 255, 190}, Time(), out);
  EXPECT_EQ(requests, (std::map<Channel, int>{{4, 1}, {5, 1}}));
  vehicle.service.handle(count, {5, 255, 190}, Time(), out);
  EXPECT_EQ(requests.at(5), 2) << "begins anew";
}

TEST(MissionService, SaysWhenThereIsNoSuchItemAndKeepsToItsKindOfList) {
  Vehicle vehicle;
  std::vector<int> acks;
  Outbox out(7, 1, [&](Channel, std::span<const std::byte> bytes) {
    mavlink::FrameParser().read(bytes, [&](const mavlink::Frame& frame) {
      on<mavlink::MissionAck>(frame, [&](const auto& m) { acks.push_back(m.type); });
    });
  });
  mavlink::MissionRequestInt request;
  request.seq = 3;
  vehicle.service.handle(request, {1, 255, 190}, out);
  request.mission_type = 1;  // a fence is another service's
  vehicle.service.handle(request, {1, 255, 190}, out);
  EXPECT_EQ(acks, (std::vector<int>{int(MissionResult::kInvalidSequence)}));
}

}  // namespace
}  // namespace skein::vehicle_services::mission_service_test
