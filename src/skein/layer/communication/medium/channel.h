// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/communication/medium/frame.h"
#include "skein/layer/communication/medium/links.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/layer/communication/medium/schedule.h"
#include "skein/role/error_model.h"

namespace skein::communication {

/// What a transceiver tells the one who decides when to send.
class ChannelListener {
 public:
  virtual ~ChannelListener() = default;

  /// The medium is busy at `node` until then, by what is known now.
  virtual void on_busy(NodeIndex node, Time now, Time until) = 0;
  /// The payload of a frame begins, which lasts until then.
  virtual void on_payload(NodeIndex node, Time now, Time until) = 0;
  virtual void on_payload_lost(NodeIndex node, Time now) = 0;
  virtual void on_received(NodeIndex node, Time now, const Frame& frame,
                           const Reception& reception) = 0;
};

/// The transceivers of all nodes and what is on the air between them.
///
/// A frame is an arrival, a detection `lock_window` later, the end of its header and its
/// own end, at each receiver at its own time. A receiver detects the strongest of the
/// frames that begin within the window, if it is strong enough and the sum of all others
/// is not too strong; the rest is noise until it ends. Bit errors follow from the ratio
/// of signal to noise and interference, piece by piece between changes.
///
/// Cost: each frame passes three times over all nodes that it reaches, in one go unless
/// something else happens meanwhile; no allocation once the busiest moment was seen.
class Channel {
 public:
  /// All outlive this.
  Channel(const PhyProfile& phy, Links& links, Schedule& schedule,
          ChannelListener& listener, std::uint64_t seed);

  /// `frame.from` begins to send; whatever it was receiving is lost.
  void transmit(const Frame& frame, Time now);

  /// An event of a frame, of the kinds kArrival to kEnd.
  void handle(const Schedule::Event& event);

  /// Whether a frame would be decoded at the other end of a link if nothing interferes.
  bool in_range(const Link& link) const { return link.power >= decode_threshold_; }

  /// How long `node` has heard that others send, until `now`.
  Time heard(NodeIndex node, Time now) const {
    const Receiver& receiver = receivers_[node];
    return receiver.heard + (receiver.hears ? now - receiver.receives_since : Time());
  }

 private:
  using FrameIndex = std::uint32_t;
  static constexpr FrameIndex kNone = 0xFFFFFFFFu;

  struct OnAir {
    Frame frame;
    Time start;
    std::vector<Link> links;            // those of its start
    std::vector<std::uint32_t> locked;  // places in links of those that detected it
    // The first of links or locked that each pass has not seen.
    std::uint32_t next_arrival = 0, next_detection = 0, next_header = 0, next_end = 0;
  };
  struct Signal {
    FrameIndex frame;
    double power;
    Time end;
  };
  struct Candidate {
    FrameIndex frame;
    double power;
  };
  struct Receiver {
    double power = 0;  // sum of all signals [W]
    FrameIndex locked = kNone;
    double locked_power = 0, least_ratio = 0;
    Time header_begin, payload_begin, judged_until;  // of the frame that it receives
    double log_header = 0, log_payload = 0;          // of success until then
    Time sending_until;
    bool hears = false;  // at least the carrier sense threshold
    Time receives_since, heard;
    std::vector<Signal> signals;
    std::vector<Candidate> candidates;  // frames whose window is open
  };

  template <class LinkOf, class Step>
  bool pass(Schedule::Event event, Time base, std::uint32_t OnAir::*next,
            const LinkOf& link_of, const Step& step);
  void arrive(FrameIndex index, const Link& link, Time now);
  void detect(FrameIndex index, std::uint32_t place, Time now);
  void finish_header(FrameIndex index, const Link& link, Time now);
  void finish(FrameIndex index, const Link& link, Time now);
  void judge(Receiver& receiver, Time now);
  bool is_lost(NodeIndex node, double log_success);
  void sense(NodeIndex node, Time now);
  void hear(Receiver& receiver, Time now) const;
  FrameIndex free_place();

  const PhyProfile& phy_;
  Links& links_;
  Schedule& schedule_;
  ChannelListener& listener_;
  double noise_, decode_threshold_, carrier_sense_threshold_, floor_;  // [W]
  double lock_ratio_;
  std::shared_ptr<const ErrorModel> errors_of_bits_;
  Time preamble_;  // before the header
  std::vector<Receiver> receivers_;
  std::vector<RandomStream> errors_;
  std::vector<OnAir> on_air_;
  std::vector<FrameIndex> free_;
};

}  // namespace skein::communication
