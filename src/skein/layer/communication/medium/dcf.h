// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/communication/medium/access.h"
#include "skein/layer/communication/medium/medium_listener.h"
#include "skein/layer/communication/medium/packet.h"
#include "skein/layer/communication/medium/power_control.h"
#include "skein/layer/communication/medium/schedule.h"

namespace skein::communication {

/// Who sends when: carrier sense with back-off, acknowledgements, RTS and CTS.
///
/// The distributed coordination function of IEEE 802.11-2016, 10.3, as packet-level
/// simulators have it: each station counts slots from its own idle start; a packet that
/// finds the medium idle waits a whole DIFS; a back-off follows each transmission; a
/// reception that begins while an answer is awaited extends the time-out; EIFS follows
/// only a payload that was lost.
class Dcf final : public Access {
 public:
  /// All but the seed outlive this; the channel is the one that this listens to.
  Dcf(const RadioProfile& profile, const Links& links, Schedule& schedule,
      PacketStore& packets, MediumListener& listener, std::uint64_t seed);
  void use(Channel& channel) override { channel_ = &channel; }

  PacketQueue& queue(NodeIndex node) override { return stations_[node].queue; }
  void enqueue(std::uint32_t packet, Time now) override;
  void handle(const Schedule::Event& event) override;

  void on_busy(NodeIndex node, Time now, Time until) override;
  void on_payload(NodeIndex node, Time now, Time until) override;
  void on_payload_lost(NodeIndex node, Time now) override;
  void on_received(NodeIndex node, Time now, const Frame& frame,
                   const Reception& reception) override;

 private:
  enum class Waiting : std::uint8_t { kNothing, kCts, kAck, kSending };

  struct Station {
    // Until when what keeps it from sending lasts, by cause.
    Time rx_end, busy_end, tx_end, nav_end, timeout_end;
    bool last_payload_lost = false;
    Time backoff_start;
    std::uint32_t backoff_slots = 0;
    std::uint32_t window = 0;
    // The head of the queue is in service from its first frame to its end.
    Waiting waiting = Waiting::kNothing;
    bool in_service = false;
    std::uint32_t rts_failures = 0, data_failures = 0;
    Time timeout_at;
    std::uint32_t timeout_stamp = 0;
    Time access_at;
    std::uint32_t access_stamp = 0;
    bool access_expected = false;
    std::uint32_t nav_stamp = 0;
    bool nav_may_reset = false;
    Frame response;  // what it sends SIFS after a reception
    PacketQueue queue;
  };

  bool is_busy(const Station& station, Time now) const;
  Time access_start(const Station& station, Time now) const;
  void count_slots(Station& station, Time now);
  void draw_backoff(NodeIndex node, Time now);
  void expect_access(NodeIndex node, Time now);
  void on_access(NodeIndex node, Time now);
  void send(const Frame& frame, Time now);
  double power_to(NodeIndex node, NodeIndex to) const;
  void send_data(NodeIndex node, Time now);
  void await(NodeIndex node, Waiting what, Time until);
  void respond(NodeIndex node, const Frame& frame, Time now);
  void on_timeout(NodeIndex node, Time now);
  void finish(NodeIndex node, PacketEnd end, Time now);
  void release(NodeIndex node, Time now);
  void reserve(NodeIndex node, const Frame& frame, Time now);

  const MacProfile& mac_;
  const PhyProfile& phy_;
  Schedule& schedule_;
  PacketStore& packets_;
  MediumListener& listener_;
  std::optional<PowerControl> power_;  // none: always all
  Channel* channel_ = nullptr;
  Time ack_airtime_, cts_airtime_, nav_reset_delay_;
  std::vector<Station> stations_;
  std::vector<RandomStream> backoffs_;
};

}  // namespace skein::communication
