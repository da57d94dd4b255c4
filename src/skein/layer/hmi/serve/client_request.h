// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "skein/base/result.h"

namespace skein::hmi {

/// A command to the run, as text or in its JSON form (docs/commands.md).
struct CommandRequest {
  std::string line;
};
/// To give commands, or to leave that to others.
struct HoldRequest {
  bool hold = true;
};
/// Another shall give commands.
struct HandOverRequest {
  std::uint32_t client = 0;
};
/// What the sender is called, for people.
struct NameRequest {
  std::string name;
};
/// Whether instructors see the truth.
struct TruthRequest {
  bool shown = true;
};
/// Of a recorded run: go to this time.
struct SeekRequest {
  double time = 0;  ///< [s]
};

/// What an aircraft would do with a task. Nothing is given to it.
struct PreviewRequest {
  std::string line;  ///< the command that would give it, in its JSON form
};

/// What a client of the live feed asks for.
struct ClientRequest {
  std::uint32_t number = 0;  ///< counts the client's requests; for the reply
  std::variant<CommandRequest, HoldRequest, HandOverRequest, NameRequest, TruthRequest,
               SeekRequest, PreviewRequest>
      what;
};

/// Reads a request: a JSON object with its "number" and one of "command", "line", "hold",
/// "hand_over", "name", "truth", "seek_s", "preview" (docs/live-feed.md).
/// Fails: kBadInput for anything else.
Result<ClientRequest> parse_client_request(std::string_view text);

}  // namespace skein::hmi
