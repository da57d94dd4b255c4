#include "app/mixed_rates.h"

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "skein/layer/communication/ideal_radio.h"
#include "skein/layer/communication/medium_radio.h"
#include "skein/layer/communication/propagation/path_loss.h"
#include "skein/link/modem/modem_link.h"
#include "skein/link/transport/endpoints.h"

namespace skein::app {
namespace {

using RealClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kAirTurn{1}, kMixedTurn{2};
constexpr double kMeeting = 10;     // in which all have found each other [s]
constexpr double kRatesWarmUp = 1;  // before it counts [s]: queues that are still empty
constexpr double kTriangleSide = 200;  // of the triangle [m]

Time since(RealClock::time_point begin) {
  return Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(RealClock::now() - begin)
          .count());
}

// The corners of a triangle of equal sides, 100 m up.
std::optional<Vec3> triangle_corner(EntityId node) {
  const Vec3 corners[] = {{0, 0, -100},
                          {kTriangleSide, 0, -100},
                          {kTriangleSide / 2, kTriangleSide * 0.8660254037844386, -100}};
  return corners[node.value % kMixedEntities];
}

std::unique_ptr<Radio> shared_medium(const assemble::RadioFile& radio, std::size_t nodes,
                                     std::uint64_t seed) {
  communication::MediumRadioOptions options;
  options.profile = radio.radio;
  options.spread = 0;
  return std::make_unique<communication::MediumRadio>(
      options,
      communication::make_propagation(radio.propagation, radio.radio.phy.frequency, seed),
      communication::RadioNodes{nodes, triangle_corner,
                                [](EntityId id) { return std::to_string(id.value); }},
      seed);
}

// Sends a message to all others, as a run does: the first and its copies.
void send_to_others(Message message, std::size_t nodes, std::uint64_t& number,
                    Radio& radio) {
  message.copy = false;
  for (std::uint32_t to = 0; to < nodes; ++to) {
    if (to == message.from.value) continue;
    message.to = EntityId{to};
    message.number = number++;
    radio.send(message);
    message.copy = true;
  }
}

// The air between real modems: it hears each at a socket, and lets a medium decide which
// of the others do.
class ModemAir final : public transport::ChannelListener {
 public:
  ModemAir(const assemble::RadioFile& radio, std::size_t modems, std::uint64_t seed)
      : modems_(modems), medium_(shared_medium(radio, modems, seed)), endpoints_(*this) {}
  ~ModemAir() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

  // Where modems find it.
  Result<transport::EndpointAddress> start() {
    auto server = transport::parse_endpoint("udpin:0");
    if (!server) return server.error();
    if (auto opened = endpoints_.open(server.value()); !opened) return opened.error();
    const auto place = transport::parse_endpoint(endpoints_.places().at(0));
    if (!place) return place.error();
    thread_ = std::thread([this] { run(); });
    return *transport::counterpart(place.value());
  }

 private:
  void run() {
    RadioNews news;
    while (!stop_) {
      endpoints_.run_for(kAirTurn);
      news.clear();
      medium_->deliver(since(begin_), news);
      for (const MessageOutcome& each : news.ended) {
        if (each.cause != LossCause::kNone || each.message.to.value >= channels_.size())
          continue;
        const auto& datagram = std::get<PluginPayload>(each.message.content).coded;
        endpoints_.send(channels_[each.message.to.value],
                        std::as_bytes(std::span(datagram)));
      }
    }
  }

  void opened(transport::ChannelId channel, transport::EndpointId,
              const std::string&) override {
    if (channels_.size() >= modems_) return;
    nodes_[channel] = static_cast<std::uint32_t>(channels_.size());
    channels_.push_back(channel);
  }
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override {
    const auto node = nodes_.find(channel);
    if (node == nodes_.end()) return;
    PluginPayload datagram{"", {}};
    for (const std::byte each : bytes)
      datagram.coded.push_back(std::to_integer<std::uint8_t>(each));
    send_to_others({EntityId{node->second}, {}, 0, since(begin_), std::move(datagram)},
                   modems_, number_, *medium_);
  }
  void closed(transport::ChannelId, const std::string&) override {}

  std::size_t modems_;
  std::unique_ptr<Radio> medium_;
  RealClock::time_point begin_ = RealClock::now();
  std::map<transport::ChannelId, std::uint32_t> nodes_;
  std::vector<transport::ChannelId> channels_;  // of the nodes
  std::uint64_t number_ = 0;
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// When an entity speaks: at even intervals, each up to a half shorter or longer.
class Speaker {
 public:
  Speaker(std::uint64_t seed, std::uint32_t entity, double rate)
      : random_(seed, entity, Purpose::kStudy), period_(8.0 * kMixedBytes / rate) {
    next_ = period_ * random_.uniform();
  }
  bool speaks(double now) {
    if (now < next_) return false;
    next_ += period_ * random_.uniform(0.5, 1.5);
    return true;
  }

 private:
  RandomStream random_;
  double period_, next_;
};

// One measurement.
class Measurement {
 public:
  explicit Measurement(const MixedRatesCase& given)
      : given_(given),
        air_(given.radio, given.set_up == MixedSetUp::kAllReal ? kMixedEntities : 2,
             given.seed) {}

  Result<MixedRates> measure(const std::atomic<bool>& stop) {
    if (auto ready = open(); !ready) return ready.error();
    if (auto met = wait_until_met(stop); !met) return met.error();
    std::vector<Speaker> speakers;
    for (std::uint32_t k = 0; k < kMixedEntities; ++k)
      speakers.emplace_back(given_.seed, k, given_.rate);
    const Time began = since(begin_);
    for (double now = 0; now < kRatesWarmUp + given_.duration;
         now = (since(begin_) - began).seconds()) {
      if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
      counts_ = now >= kRatesWarmUp;
      for (std::uint32_t k = 0; k < kMixedEntities; ++k)
        if (speakers[k].speaks(now)) say(EntityId{k});
      step();
      std::this_thread::sleep_for(kMixedTurn);
    }
    MixedRates rates;
    for (std::size_t from = 0; from < kMixedEntities; ++from)
      for (std::size_t to = 0; to < kMixedEntities; ++to)
        rates.received[from][to] =
            static_cast<double>(kMixedBytes * messages_[from][to]) / given_.duration;
    if (simulated_) rates.station = modems_.back()->statistics();
    return rates;
  }

 private:
  // Entity 0 is real in any case.
  Result<void> open() {
    const auto place = air_.start();
    if (!place) return place.error();
    const auto add = [&](std::vector<EntityId> identities) -> Result<void> {
      modem::ModemLinkOptions options;
      options.endpoint = place.value();
      options.peer.hw = static_cast<std::uint32_t>(modems_.size() + 1);
      options.peer.session = given_.seed + 1;
      options.peer.entities = kMixedEntities;
      options.peer.overhears = identities.size() > 1;
      if (given_.set_up == MixedSetUp::kMixed && identities.size() > 1)
        options.peer.queue.rate = given_.radio.radio.phy.rate;
      options.peer.identities = std::move(identities);
      modems_.push_back(std::make_unique<modem::ModemLink>(options));
      auto started = modems_.back()->start();
      if (!started) return started.error();
      return {};
    };
    if (auto added = add({EntityId{0}}); !added) return added;
    if (given_.set_up == MixedSetUp::kAllReal) {
      if (auto added = add({EntityId{1}}); !added) return added;
      return add({EntityId{2}});
    }
    if (given_.set_up == MixedSetUp::kMixed)
      simulated_ = shared_medium(given_.radio, kMixedEntities, given_.seed + 1000);
    else
      simulated_ = std::make_unique<communication::IdealRadio>(
          communication::IdealRadioOptions{}, given_.seed, nullptr);
    return add({EntityId{1}, EntityId{2}});
  }

  Result<void> wait_until_met(const std::atomic<bool>& stop) {
    const std::size_t pairs = simulated_ ? 3 : 6;
    for (std::size_t all = 0; all < pairs;) {
      if (stop) return Error{ErrorCode::kInterrupted, "", "interrupted.", ""};
      if (since(begin_).seconds() > kMeeting)
        return Error{ErrorCode::kUnavailable, given_.radio.name,
                     "the modems do not find each other.", ""};
      std::this_thread::sleep_for(kMixedTurn);
      for (const auto& modem : modems_)
        for (const modem::Heard& heard : modem->take(since(begin_)))
          all += std::holds_alternative<modem::NeighbourChange>(heard) ? 1 : 0;
    }
    return {};
  }

  bool is_real(EntityId entity) const { return !simulated_ || entity.value == 0; }

  void say(EntityId entity) {
    const Time now = since(begin_);
    Message message{entity, kEveryone, number_++, now,
                    PluginPayload{"", std::vector<std::uint8_t>(kMixedBytes)}};
    if (is_real(entity))
      modems_[entity.value]->send(now, message);
    else
      send_to_others(message, kMixedEntities, number_, *simulated_);
  }

  void count(EntityId from, EntityId to) {
    if (counts_) ++messages_.at(from.value).at(to.value);
  }

  void step() {
    const Time now = since(begin_);
    for (std::uint32_t k = 0; k < modems_.size(); ++k)
      for (const modem::Heard& heard : modems_[k]->take(now)) {
        const auto* message = std::get_if<Message>(&heard);
        if (!message) continue;
        if (simulated_ && k == 1)  // the ground station puts it on the medium
          send_to_others({message->from, {}, 0, now, message->content}, kMixedEntities,
                         number_, *simulated_);
        else
          count(message->from, EntityId{k});
      }
    if (!simulated_) return;
    news_.clear();
    simulated_->deliver(now, news_);
    for (const MessageOutcome& each : news_.ended) {
      if (each.cause != LossCause::kNone) continue;
      if (is_real(each.message.to))
        modems_.back()->send(now, each.message);
      else
        count(each.message.from, each.message.to);
    }
  }

  MixedRatesCase given_;
  RealClock::time_point begin_ = RealClock::now();
  ModemAir air_;
  std::vector<std::unique_ptr<modem::ModemLink>> modems_;  // the last: the station's
  std::unique_ptr<Radio> simulated_;                       // null: all are real
  std::array<std::array<std::size_t, kMixedEntities>, kMixedEntities> messages_ = {};
  bool counts_ = false;
  std::uint64_t number_ = 0;
  RadioNews news_;
};

}  // namespace

Result<MixedRates> measure_mixed_rates(const MixedRatesCase& given,
                                       const std::atomic<bool>& stop) {
  return Measurement(given).measure(stop);
}

}  // namespace skein::app
