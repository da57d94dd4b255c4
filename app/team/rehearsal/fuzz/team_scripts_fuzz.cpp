// SPDX-License-Identifier: Apache-2.0
// Any bytes are scripts or an error that says what is wrong; small scripts are played.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/team/rehearsal/rehearsal.h"
#include "skein/base/check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::rehearsal;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto scripts = read_team_scripts(text, "fuzz");
  if (!scripts) {
    SKEIN_CHECK(!scripts.error().message.empty());
    return 0;
  }
  for (const TeamScript& script : scripts.value())
    if (script.aircraft.size() <= 5 && script.end <= 60 && script.tasks <= 10)
      (void)rehearse(script, {}, {});
  return 0;
}
