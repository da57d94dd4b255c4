// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/link/mavlink/payload.h"
#include "skein/link/mavlink/sequence_watch.h"
#include "skein/link/vehicle_services/test/bad_line.h"
#include "skein/link/vehicle_services/test/paper_vehicle.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services {

/// A ground station's part of each protocol, over a line that loses, delays and mixes up
/// frames, with a vehicle at its other end. Each call waits until it is done or has been
/// tried often enough.
class GroundStation {
 public:
  using Item = mavlink::MissionItemInt;
  static constexpr Channel kLink = 1;
  static constexpr int kTries = 12;

  GroundStation(const VehicleServerOptions& options, const Trouble& trouble,
                unsigned seed, mavlink::LinkSecurity* of_vehicle = nullptr,
                mavlink::LinkSecurity* of_station = nullptr)
      : line(trouble, seed, of_vehicle, of_station),
        server(options, test_frame()),
        paper(standing()),
        late_(2 * (trouble.delay + trouble.jitter)) {
    line.at_vehicle = [this, of_vehicle](const mavlink::Frame& frame) {
      if (!of_vehicle || of_vehicle->admits(kLink, frame))
        server.receive(frame, kLink, clocks(), line.vehicle);
    };
    line.at_station = [this, of_station](const mavlink::Frame& frame) {
      if (!of_station || of_station->admits(kLink, frame)) hear(frame);
    };
    server.open(kLink, clocks());
  }

  /// Lets time pass until something has come true; @returns whether it did.
  bool wait(double seconds, const std::function<bool()>& until) {
    const Time end = line.now + Time::from_seconds(seconds);
    while (!until() && line.now < end) step();
    return until();
  }

  template <class T>
  void send(T message) {
    message.target_system = 7;
    message.target_component = 1;
    line.station.send(kLink, message);
  }

  /// Sends a command until it is answered for good.
  /// @returns  the result; -1 for none.
  int command(mavlink::CommandId id, const std::vector<float>& p = {}) {
    mavlink::CommandLong m;
    m.command = static_cast<std::uint16_t>(id);
    const auto at = [&](std::size_t k) { return k < p.size() ? p[k] : 0.F; };
    m.param1 = at(0);
    m.param2 = at(1);
    m.param3 = at(2);
    m.param4 = at(3);
    m.param5 = at(4);
    m.param6 = at(5);
    m.param7 = at(6);
    expect_answer(m.command);
    for (int k = 0; k < kTries; ++k) {
      m.confirmation = static_cast<std::uint8_t>(k);
      send(m);
      // While it is in progress it is waited for; after silence it is asked again.
      heard_ack_ = line.now;
      while (!ack_ && line.now - heard_ack_ < Time::from_seconds(3)) step();
      if (ack_) return *ack_;
    }
    return -1;
  }

  /// The same for COMMAND_INT.
  int command(mavlink::CommandInt m) {
    expect_answer(m.command);
    for (int k = 0; k < kTries; ++k) {
      send(m);
      if (wait(3, [&] { return ack_.has_value(); })) return *ack_;
    }
    return -1;
  }

  /// Asks for a message until it comes.
  template <class T>
  std::optional<T> request(float detail = 0) {
    counts[mavlink::kFacts<T>.id] = 0;
    for (int k = 0; k < kTries; ++k) {
      const int result = command(mavlink::CommandId::kRequestMessage,
                                 {static_cast<float>(mavlink::kFacts<T>.id), detail});
      if (result != 0) return std::nullopt;
      if (wait(2, [&] { return counts[mavlink::kFacts<T>.id] > 0; }))
        return mavlink::unpack<T>(payloads[mavlink::kFacts<T>.id]);
    }
    return std::nullopt;
  }

  /// The list, then what is missing, ten at a time.
  bool load_parameters() {
    for (int k = 0; k < kTries && (!count_ || parameters.size() < *count_); ++k) {
      if (!count_) {
        send(mavlink::ParamRequestList());
      } else {
        int asked = 0;
        for (std::size_t i = 0; i < *count_ && asked < 10; ++i)
          if (!parameters.contains(static_cast<int>(i))) {
            mavlink::ParamRequestRead read;
            read.param_index = static_cast<std::int16_t>(i);
            send(read);
            ++asked;
          }
      }
      wait(3, [&] { return count_ && parameters.size() == *count_; });
    }
    return count_ && parameters.size() == *count_;
  }

  /// @returns  the vehicle's verdict; -1 for none.
  int upload(const std::vector<Item>& items, mavlink::MissionType type) {
    uploading_ = &items;
    type_ = static_cast<std::uint8_t>(type);
    verdict_.reset();
    asked_ = false;
    for (int k = 0; k < 5 * kTries && !verdict_; ++k) {
      if (!asked_) {
        mavlink::MissionCount count;
        count.count = static_cast<std::uint16_t>(items.size());
        count.mission_type = type_;
        send(count);
      } else if (line.now - heard_request_ > Time::from_seconds(1.5)) {
        send_item(items.size() - 1);
      }
      wait(1.5, [&] { return verdict_.has_value(); });
    }
    uploading_ = nullptr;
    return verdict_.value_or(-1);
  }

  /// @returns  none when it did not come.
  std::optional<std::vector<Item>> download(mavlink::MissionType type) {
    type_ = static_cast<std::uint8_t>(type);
    list_count_.reset();
    items_.clear();
    const auto done = [&] { return list_count_ && items_.size() == *list_count_; };
    for (int k = 0; k < 5 * kTries && !done(); ++k) {
      if (!list_count_) {
        mavlink::MissionRequestList list;
        list.mission_type = type_;
        send(list);
      } else {
        for (std::size_t i = 0, asked = 0; i < *list_count_ && asked < 5; ++i)
          if (!items_.contains(static_cast<int>(i))) {
            mavlink::MissionRequestInt request;
            request.seq = static_cast<std::uint16_t>(i);
            request.mission_type = type_;
            send(request);
            ++asked;
          }
      }
      const std::size_t before = items_.size();
      wait(1.5, [&] { return done() || items_.size() >= before + 5; });
    }
    if (!done()) return std::nullopt;
    std::vector<Item> list;
    for (const auto& [number, item] : items_) list.push_back(item);
    return list;
  }

  template <class T>
  T last() {
    EXPECT_GT(counts[mavlink::kFacts<T>.id], 0) << mavlink::kFacts<T>.name;
    return mavlink::unpack<T>(payloads[mavlink::kFacts<T>.id]);
  }

  Clocks clocks() const { return {line.now, line.now}; }

  BadLine line;
  VehicleServer server;
  PaperVehicle paper;
  std::map<std::uint32_t, int> counts;  ///< messages heard, by their id
  std::map<std::uint32_t, std::vector<std::byte>> payloads;  ///< the newest of each
  std::map<int, std::string> parameters;                     ///< names by index
  std::vector<int> progress;                                 ///< of a take-off
  mavlink::SequenceWatch lost;

 private:
  // Answers do not say to what: late ones, to what was asked before, are waited out.
  void expect_answer(std::uint16_t command) {
    wait(late_, [] { return false; });
    waiting_for_ = command;
    ack_.reset();
  }

  void step() {
    line.step();
    if (++steps_ % 10 == 0) {
      for (const VehicleRequest& request : server.take_requests()) paper.obey(request);
      paper.step(0.1);
      paper.snapshot.motion.time = line.now;
      server.update(paper.snapshot);
    }
    if (steps_ % 2 == 0) server.step(clocks(), line.vehicle);
    if (steps_ % 100 == 0) line.station.send(kLink, mavlink::Heartbeat());
  }

  void send_item(std::size_t number) {
    Item item = (*uploading_)[number];
    item.seq = static_cast<std::uint16_t>(number);
    item.mission_type = type_;
    send(item);
  }

  void hear(const mavlink::Frame& frame) {
    EXPECT_EQ(frame.system(), 7);
    lost.hear(frame);
    ++counts[frame.id()];
    payloads[frame.id()].assign(frame.payload().begin(), frame.payload().end());
    on<mavlink::CommandAck>(frame, [&](const auto& m) {
      EXPECT_EQ(m.target_system, 255);
      EXPECT_EQ(m.target_component, 190);
      if (m.command != waiting_for_) return;
      heard_ack_ = line.now;
      if (m.result != static_cast<int>(mavlink::CommandResult::kInProgress))
        ack_ = m.result;
      else
        progress.push_back(m.progress);
    });
    on<mavlink::ParamValue>(frame, [&](const auto& m) {
      if (m.param_index == 65'535) return;
      parameters[m.param_index] = mavlink::text_of(m.param_id);
      count_ = m.param_count;
    });
    on<mavlink::MissionRequestInt>(frame, [&](const auto& m) {
      if (!uploading_ || m.mission_type != type_ || m.seq >= uploading_->size()) return;
      asked_ = true;
      heard_request_ = line.now;
      send_item(m.seq);
    });
    on<mavlink::MissionAck>(frame, [&](const auto& m) {
      if (uploading_ && m.mission_type == type_) verdict_ = m.type;
    });
    on<mavlink::MissionCount>(frame, [&](const auto& m) {
      if (m.mission_type == type_) list_count_ = m.count;
    });
    on<Item>(frame, [&](const auto& m) {
      if (m.mission_type == type_) items_[m.seq] = m;
    });
  }

  double late_;  // [s]
  int steps_ = 0;
  std::uint16_t waiting_for_ = 0;
  std::optional<int> ack_, verdict_;
  Time heard_ack_, heard_request_;
  std::optional<std::size_t> count_, list_count_;
  const std::vector<Item>* uploading_ = nullptr;
  std::uint8_t type_ = 0;
  bool asked_ = false;
  std::map<int, Item> items_;
};

}  // namespace skein::vehicle_services
