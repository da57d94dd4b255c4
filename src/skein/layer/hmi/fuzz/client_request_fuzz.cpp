// SPDX-License-Identifier: Apache-2.0
// Any text is refused, or is a request whose command can be looked at; any cookies and
// hosts can be looked at, and any table of tokens; so can what viewers say by Foxglove's
// protocol.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "skein/base/check.h"
#include "skein/data/command/command_text.h"
#include "skein/layer/hmi/serve/access.h"
#include "skein/layer/hmi/serve/client_request.h"
#include "skein/layer/hmi/serve/foxglove/protocol.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string_view token = skein::hmi::token_in_cookies(text);
  SKEIN_CHECK(token.size() <= text.size());
  if (skein::hmi::names_this_machine(text)) SKEIN_CHECK(!text.empty());
  if (const auto table = skein::hmi::AccessTable::parse(text, "fuzz"))
    SKEIN_CHECK(!table.value().is_open());
  if (const auto said = skein::hmi::foxglove::parse_client_message(text))
    SKEIN_CHECK(text.find("subscribe") != std::string_view::npos);
  const auto request = skein::hmi::parse_client_request(text);
  if (!request) return 0;
  if (const auto* command =
          std::get_if<skein::hmi::CommandRequest>(&request.value().what))
    static_cast<void>(skein::parse_command(command->line));
  if (const auto* preview =
          std::get_if<skein::hmi::PreviewRequest>(&request.value().what))
    static_cast<void>(skein::parse_command(preview->line));
  return 0;
}
