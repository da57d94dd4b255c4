#pragma once

#include "skein/role/phenomenon.h"

namespace skein::environment {

/// Nothing burns.
class NoFire final : public Phenomenon {
 public:
  void advance(Time) override {}
  bool inside(const Vec2&) const override { return false; }
  const geo::Region& region() const override { return region_; }

 private:
  geo::Region region_;
};

}  // namespace skein::environment
