// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/frame.h"
#include "skein/link/mavlink/payload.h"

namespace skein::mavlink {

/// Calls handle(message) when the frame is one of these kinds.
/// @returns  whether it was.
template <Message... Kinds, class Handle>
bool dispatch(const Frame& frame, Handle&& handle) {
  if (!frame.message) return false;
  const auto try_one = [&]<class T>(const T*) {
    if (frame.id() != kFacts<T>.id) return false;
    handle(unpack<T>(frame.payload()));
    return true;
  };
  return (try_one(static_cast<const Kinds*>(nullptr)) || ...);
}

}  // namespace skein::mavlink
