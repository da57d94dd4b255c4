// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "skein/data/command/command.h"
#include "skein/data/describe/describe.h"
#include "skein/data/radio/message.h"
#include "skein/data/vehicle/sensing.h"

// What an entity is given whose vehicle and agent are both in another program.

namespace skein {

/// What its payload has measured in the world.
struct PayloadReadings {
  std::vector<SensorSample> samples;
};

constexpr auto describe(const PayloadReadings*) {
  using T = PayloadReadings;
  return described<T>({"payload"}, "What virtual payload has measured.",
                      field("samples", &T::samples, Storage::kJson, "in order"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using EntityInput = std::variant<PayloadReadings, Message, Command>;

}  // namespace skein
