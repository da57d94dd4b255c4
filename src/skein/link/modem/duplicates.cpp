#include "skein/link/modem/duplicates.h"

#include <utility>

namespace skein::modem {
namespace {

constexpr std::size_t kMaxOrigins = 1000;
constexpr Time kSessionMemory = Time::from_ns(10'000'000'000);
constexpr std::uint64_t kWindow = 64;

}  // namespace

bool Duplicates::is_new(std::uint32_t origin, std::uint64_t session, std::uint64_t number,
                        Time now) {
  if (!origins_.contains(origin) && origins_.size() >= kMaxOrigins) return false;
  Origin& known = origins_[origin];
  if (session != known.session) {
    if (session < known.session && now - known.heard <= kSessionMemory) return false;
    known = {session, 0, 0, now};
  }
  known.heard = now;
  if (number > known.newest) {
    const std::uint64_t by = number - known.newest;
    known.before = by < kWindow ? (known.before << by | std::uint64_t{1} << (by - 1)) : 0;
    known.newest = number;
    return true;
  }
  const std::uint64_t back = known.newest - number;
  if (back == 0 || back > kWindow) return false;
  const std::uint64_t bit = std::uint64_t{1} << (back - 1);
  return (std::exchange(known.before, known.before | bit) & bit) == 0;
}

}  // namespace skein::modem
