// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

/// Numbers that messages use: those of MAVLink's enumerations that Skein speaks of. Facts
/// of the same definitions as messages.txt.
namespace skein::mavlink {

/// MAV_TYPE.
enum class VehicleType : std::uint8_t {
  kFixedWing = 1,
  kQuadrotor = 2,
  kGroundStation = 6,
};

/// MAV_STATE.
enum class SystemState : std::uint8_t {
  kBoot = 1,
  kStandby = 3,
  kActive = 4,
  kCritical = 5,
  kEmergency = 6,
};

/// MAV_SEVERITY of a text, as in system logs.
enum class Severity : std::uint8_t {
  kEmergency = 0,
  kAlert = 1,
  kCritical = 2,
  kError = 3,
  kWarning = 4,
  kNotice = 5,
  kInfo = 6,
  kDebug = 7,
};

/// MAV_PROTOCOL_CAPABILITY.
namespace capability {
inline constexpr std::uint64_t kMissionFloat = 1;
inline constexpr std::uint64_t kParamFloat = 2;
inline constexpr std::uint64_t kMissionInt = 4;
inline constexpr std::uint64_t kCommandInt = 8;
inline constexpr std::uint64_t kParamEncodeBytes = 16;
inline constexpr std::uint64_t kSetAttitudeTarget = 64;
inline constexpr std::uint64_t kSetPositionTargetLocal = 128;
inline constexpr std::uint64_t kSetPositionTargetGlobal = 256;
inline constexpr std::uint64_t kMavlink2 = 8192;
inline constexpr std::uint64_t kMissionFence = 16'384;
inline constexpr std::uint64_t kMissionRally = 32'768;
inline constexpr std::uint64_t kParamEncodeCast = 131'072;
}  // namespace capability

/// MAV_SYS_STATUS_SENSOR.
namespace sensor_bit {
inline constexpr std::uint32_t kGyro = 1;
inline constexpr std::uint32_t kAccelerometer = 2;
inline constexpr std::uint32_t kMagnetometer = 4;
inline constexpr std::uint32_t kAbsolutePressure = 8;
inline constexpr std::uint32_t kDifferentialPressure = 16;
inline constexpr std::uint32_t kGps = 32;
inline constexpr std::uint32_t kRateControl = 1024;
inline constexpr std::uint32_t kAttitudeControl = 2048;
inline constexpr std::uint32_t kYawControl = 4096;
inline constexpr std::uint32_t kAltitudeControl = 8192;
inline constexpr std::uint32_t kPositionControl = 16'384;
inline constexpr std::uint32_t kMotorOutputs = 32'768;
inline constexpr std::uint32_t kRcReceiver = 65'536;
inline constexpr std::uint32_t kGeofence = 1'048'576;
inline constexpr std::uint32_t kAhrs = 2'097'152;
inline constexpr std::uint32_t kBattery = 33'554'432;
inline constexpr std::uint32_t kPreArmCheck = 268'435'456;
}  // namespace sensor_bit

/// Bits that ESTIMATOR_STATUS and EKF_STATUS_REPORT have in common.
namespace estimator_bit {
inline constexpr std::uint16_t kAttitude = 1;
inline constexpr std::uint16_t kHorizontalVelocity = 2;
inline constexpr std::uint16_t kVerticalVelocity = 4;
inline constexpr std::uint16_t kRelativePosition = 8;
inline constexpr std::uint16_t kAbsolutePosition = 16;
inline constexpr std::uint16_t kAltitude = 32;
inline constexpr std::uint16_t kConstantPosition = 128;
inline constexpr std::uint16_t kPredictsRelativePosition = 256;
inline constexpr std::uint16_t kPredictsAbsolutePosition = 512;
}  // namespace estimator_bit

/// MAV_LANDED_STATE.
enum class LandedState : std::uint8_t {
  kOnGround = 1,
  kInAir = 2,
  kTakeOff = 3,
  kLanding = 4,
};

/// MAV_BATTERY_CHARGE_STATE.
enum class ChargeState : std::uint8_t {
  kOk = 1,
  kLow = 2,
  kCritical = 3,
};

/// GPS_FIX_TYPE.
enum class GpsFix : std::uint8_t {
  kNoFix = 1,
  k3d = 3,
};

/// MAV_FRAME: what coordinates of a message count from.
enum class CoordinateFrame : std::uint8_t {
  kGlobal = 0,  ///< altitude above mean sea level
  kLocalNed = 1,
  kMission = 2,         ///< no place
  kGlobalRelative = 3,  ///< altitude above home
  kGlobalInt = 5,
  kGlobalRelativeInt = 6,
  kLocalOffsetNed = 7,  ///< from where the vehicle is
  kBodyNed = 8,         ///< the same, and turned by its heading
  kBodyOffsetNed = 9,
  kGlobalTerrain = 10,  ///< altitude above the ground there
  kGlobalTerrainInt = 11,
  kBodyFrd = 12,
};

/// POSITION_TARGET_TYPEMASK: what of a setpoint is to be left out.
namespace position_target {
inline constexpr std::uint16_t kIgnoreX = 1;
inline constexpr std::uint16_t kIgnoreVx = 8;
inline constexpr std::uint16_t kIgnoreAx = 64;
inline constexpr std::uint16_t kForce = 512;  ///< accelerations are forces
inline constexpr std::uint16_t kIgnoreYaw = 1024;
}  // namespace position_target

/// ATTITUDE_TARGET_TYPEMASK.
inline constexpr std::uint8_t kIgnoreAttitude = 128;

/// MAV_CMD: what COMMAND_LONG, COMMAND_INT and items of missions ask for.
enum class CommandId : std::uint16_t {
  kWaypoint = 16,
  kLoiter = 17,
  kLoiterTurns = 18,
  kLoiterTime = 19,
  kReturn = 20,
  kLand = 21,
  kTakeOff = 22,
  kSetMode = 176,
  kJump = 177,
  kChangeSpeed = 178,
  kSetHome = 179,
  kReposition = 192,
  kPauseContinue = 193,
  kFenceEnable = 207,
  kSetMissionCurrent = 224,
  kReboot = 246,
  kMissionStart = 300,
  kArm = 400,
  kGetHome = 410,
  kGetMessageInterval = 510,
  kSetMessageInterval = 511,
  kRequestMessage = 512,
  kRequestProtocolVersion = 519,
  kRequestCapabilities = 520,
  kFenceReturnPoint = 5000,
  kFenceInclusionVertex = 5001,
  kFenceExclusionVertex = 5002,
  kFenceInclusionCircle = 5003,
  kFenceExclusionCircle = 5004,
  kRallyPoint = 5100,
  kGuidedSpeed = 43'000,
  kGuidedAltitude = 43'001,
  kGuidedHeading = 43'002,
};

/// Arms or disarms whatever the checks say.
inline constexpr float kForceArming = 21'196;

/// MAV_RESULT of a command.
enum class CommandResult : std::uint8_t {
  kAccepted = 0,
  kTemporarilyRejected = 1,
  kDenied = 2,
  kUnsupported = 3,
  kFailed = 4,
  kInProgress = 5,
  kCancelled = 6,
  kLongOnly = 7,
  kIntOnly = 8,
  kUnsupportedFrame = 9,
};

/// MAV_DATA_STREAM: groups of messages whose rate is asked for together.
enum class StreamGroup : std::uint8_t {
  kAll = 0,
  kRawSensors = 1,
  kExtendedStatus = 2,
  kRcChannels = 3,
  kRawController = 4,
  kPosition = 6,
  kExtra1 = 10,
  kExtra2 = 11,
  kExtra3 = 12,
};

enum class ParamErrorCode : std::uint8_t {
  kDoesNotExist = 1,
  kOutOfRange = 2,
  kReadOnly = 5,
};

/// What a list of mission items is.
enum class MissionType : std::uint8_t {
  kMission = 0,
  kFence = 1,
  kRally = 2,
  kAll = 255,
};

enum class MissionResult : std::uint8_t {
  kAccepted = 0,
  kError = 1,
  kUnsupportedFrame = 2,
  kUnsupported = 3,
  kNoSpace = 4,
  kInvalid = 5,
  kInvalidParam1 = 6,
  kInvalidParam2 = 7,
  kInvalidX = 10,
  kInvalidY = 11,
  kInvalidZ = 12,
  kInvalidSequence = 13,
  kDenied = 14,
  kCancelled = 15,
};

/// MISSION_STATE.
enum class MissionState : std::uint8_t {
  kNoMission = 1,
  kNotStarted = 2,
  kActive = 3,
  kPaused = 4,
  kComplete = 5,
};

/// MAV_STANDARD_MODE: modes that have the same meaning with all makes.
enum class StandardMode : std::uint8_t {
  kNone = 0,
  kReturn = 5,
  kMission = 6,
  kLand = 7,
  kTakeOff = 8,
};

/// MAV_MODE_PROPERTY.
namespace mode_property {
inline constexpr std::uint32_t kAdvanced = 1;
inline constexpr std::uint32_t kNotSelectable = 2;
inline constexpr std::uint32_t kAuto = 4;
}  // namespace mode_property

/// Operations of the file transfer protocol, in the payload of its messages.
enum class FileOperation : std::uint8_t {
  kTerminateSession = 1,
  kResetSessions = 2,
  kAck = 128,
  kNak = 129,
};

}  // namespace skein::mavlink
