// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/telemetry_requests.h"

#include "skein/link/autopilot_client/request_steps.h"

namespace skein::autopilot_client {
namespace {

const Time kHomePeriod = Time::from_seconds(10);
const Time kVersionPeriod = Time::from_seconds(10);

// A message, and its rate.
struct Stream {
  std::uint32_t message;
  double rate;  // [Hz]; 0: that of the motion
};
constexpr Stream kStreams[] = {
    {mavlink::kFacts<mavlink::GlobalPositionInt>.id, 0},
    {mavlink::kFacts<mavlink::Attitude>.id, 0},
    {mavlink::kFacts<mavlink::VfrHud>.id, 2},
    {mavlink::kFacts<mavlink::SysStatus>.id, 1},
    {mavlink::kFacts<mavlink::GpsRawInt>.id, 2},
    {mavlink::kFacts<mavlink::ExtendedSysState>.id, 2},
    {mavlink::kFacts<mavlink::MissionCurrent>.id, 1},
    {mavlink::kFacts<mavlink::SystemTime>.id, 1},
    {mavlink::kFacts<mavlink::HomePosition>.id, 0.5},
};
constexpr double kOneHertz = 1e6;  // [us]

}  // namespace

void TelemetryRequests::set_interval(std::uint32_t message, double interval_us) {
  sender_.add({0,
               {command(kSetMessageInterval, static_cast<float>(message),
                        static_cast<float>(interval_us))}});
}

void TelemetryRequests::request(std::uint32_t message) {
  sender_.add({0, {command(kRequestMessage, static_cast<float>(message))}});
}

void TelemetryRequests::begin(mavlink::Make make, Time now) {
  home_due_ = now + kHomePeriod;
  version_due_ = now + kVersionPeriod;
  for (const Stream& stream : kStreams)
    set_interval(stream.message, 1e6 / (stream.rate > 0 ? stream.rate : rate_));
  request(mavlink::kFacts<mavlink::AutopilotVersion>.id);
  request(mavlink::kFacts<mavlink::HomePosition>.id);
  const bool ardupilot = make == mavlink::Make::kArduPilot;
  set_interval(ardupilot ? mavlink::kFacts<mavlink::Wind>.id
                         : mavlink::kFacts<mavlink::WindCov>.id,
               kOneHertz);
  set_interval(ardupilot ? mavlink::kFacts<mavlink::EkfStatusReport>.id
                         : mavlink::kFacts<mavlink::EstimatorStatus>.id,
               kOneHertz);
}

void TelemetryRequests::step(Time now, bool home_is_known,
                             vehicle_services::Channel channel,
                             vehicle_services::Outbox& out) {
  if (!home_is_known && now >= home_due_) {
    home_due_ = now + kHomePeriod;
    request(mavlink::kFacts<mavlink::HomePosition>.id);
  }
  if (now >= version_due_) {
    version_due_ = now + kVersionPeriod;
    request(mavlink::kFacts<mavlink::AutopilotVersion>.id);
  }
  sender_.step(now, channel, out);
}

}  // namespace skein::autopilot_client
