#pragma once

#include <cstdint>

/// Numbers that messages use: those of MAVLink's enumerations that Skein speaks of. Facts
/// of the same definitions as messages.txt.
namespace skein::mavlink {

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
  kInvalidX = 10,
  kInvalidY = 11,
  kInvalidZ = 12,
  kInvalidSequence = 13,
  kDenied = 14,
  kCancelled = 15,
};

}  // namespace skein::mavlink
