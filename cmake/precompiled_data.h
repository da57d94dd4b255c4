// SPDX-License-Identifier: Apache-2.0
#pragma once

// What lies in precompiled.h, and the values that layers exchange, for all that stands on
// them (cmake/precompiled.cmake). No file counts on it: each includes what it uses.

#include "precompiled.h"
#include "skein/base/result.h"
#include "skein/data/event/record.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
