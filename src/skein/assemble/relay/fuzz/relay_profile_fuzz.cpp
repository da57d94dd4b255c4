// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "skein/assemble/relay/relay_profile.h"

// Any bytes: no crash, and whatever is accepted is written as a file that reads as the
// same profile.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skein::assemble;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto profile = read_relay_profile(text, "fuzz");
  if (!profile) {
    if (profile.error().message.empty()) std::abort();
    return 0;
  }
  const std::string written = write_relay_profile(profile.value());
  const auto again = read_relay_profile(written, "written");
  if (!again || write_relay_profile(again.value()) != written) std::abort();
  skein::impairment::ImpairmentSchedule schedule(plan_of(again.value()));
  while (schedule.next()) schedule.step();
  return 0;
}
