// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/unsigned_frames.h"

#include <algorithm>
#include <cstdint>

#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/payload.h"

namespace skein::mavlink {
namespace {

template <class... Messages>
bool is_one_of(std::uint32_t id) {
  return ((id == kFacts<Messages>.id) || ...);
}

bool is_report(std::uint32_t id) {
  return is_one_of<
      Heartbeat, SysStatus, SystemTime, Ping, Timesync, LinkNodeStatus, ParamValue,
      GpsRawInt, Gps2Raw, GpsStatus, ScaledImu, ScaledImu2, ScaledImu3, RawImu,
      HighresImu, ScaledPressure, ScaledPressure2, ScaledPressure3, Attitude,
      AttitudeQuaternion, LocalPositionNed, LocalPositionNedCov, GlobalPositionInt,
      RcChannels, RcChannelsRaw, ServoOutputRaw, MissionCurrent, MissionItemReached,
      MissionAck, GpsGlobalOrigin, NavControllerOutput, DataStream, VfrHud, CommandAck,
      AttitudeTarget, PositionTargetLocalNed, PositionTargetGlobalInt, RadioStatus,
      PowerStatus, Altitude, BatteryStatus, AutopilotVersion, Meminfo, FenceStatus, Ahrs,
      Ahrs2, Hwstatus, Radio, Wind, Rangefinder, EkfStatusReport, TerrainReport, WindCov,
      HomePosition, ExtendedSysState, Statustext, Vibration>(id);
}

bool is_question(std::uint32_t id) {
  return is_one_of<ParamRequestRead, ParamRequestList, MissionRequest, MissionRequestInt,
                   MissionRequestList, RequestDataStream, AutopilotVersionRequest>(id);
}

bool asks_only(std::uint16_t command) {
  constexpr CommandId kQuestions[] = {CommandId::kGetHome,
                                      CommandId::kGetMessageInterval,
                                      CommandId::kRequestMessage,
                                      CommandId::kSetMessageInterval,
                                      CommandId::kRequestProtocolVersion,
                                      CommandId::kRequestCapabilities};
  return std::ranges::find(kQuestions, static_cast<CommandId>(command)) !=
         std::end(kQuestions);
}

}  // namespace

bool changes_nothing(const Frame& frame) {
  if (!frame.message) return false;
  const std::uint32_t id = frame.id();
  if (id == kFacts<CommandLong>.id)
    return asks_only(unpack<CommandLong>(frame.payload()).command);
  if (id == kFacts<CommandInt>.id)
    return asks_only(unpack<CommandInt>(frame.payload()).command);
  return is_report(id) || is_question(id);
}

}  // namespace skein::mavlink
