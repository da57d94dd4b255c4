#include "base/random.h"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

#include "base/check.h"

namespace skein {

RandomStream::RandomStream(std::uint64_t seed, std::uint32_t entity, Purpose purpose,
                           std::uint32_t instance)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      stream_{entity, static_cast<std::uint32_t>(purpose) | instance << 16} {
  SKEIN_CHECK(instance < 1u << 16, instance);
}

void RandomStream::refill() {
  const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(index_),
                                            static_cast<std::uint32_t>(index_ >> 32),
                                            stream_[0], stream_[1]}};
  const r123::Philox4x32::key_type key{{key_[0], key_[1]}};
  const auto out = r123::Philox4x32()(counter, key);
  block_[1] = out[0] | (static_cast<std::uint64_t>(out[1]) << 32);
  block_[0] = out[2] | (static_cast<std::uint64_t>(out[3]) << 32);
  left_ = 2;
  ++index_;
}

std::uint64_t RandomStream::bits() {
  if (left_ == 0) refill();
  return block_[static_cast<std::size_t>(--left_)];
}

double RandomStream::uniform() {
  return static_cast<double>(bits() >> 11) * 0x1.0p-53;
}

double RandomStream::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));  // 1 - u is in (0, 1]
  const double angle = 2 * std::numbers::pi * uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

void RandomStream::seek(std::uint64_t index) {
  index_ = index;
  left_ = 0;
  has_spare_ = false;
}

}  // namespace skein
