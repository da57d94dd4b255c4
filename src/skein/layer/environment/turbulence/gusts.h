// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "skein/role/turbulence.h"

namespace skein::environment {

/// Several kinds of gusts at once: their sum.
class Gusts final : public Turbulence {
 public:
  explicit Gusts(std::vector<std::unique_ptr<Turbulence>> parts)
      : parts_(std::move(parts)) {}

  Gust advance(const TurbulenceView& view, double dt) override {
    Gust sum;
    for (const auto& part : parts_) {
      const Gust gust = part->advance(view, dt);
      sum.velocity_N += gust.velocity_N;
      sum.rates_B += gust.rates_B;
    }
    return sum;
  }

 private:
  std::vector<std::unique_ptr<Turbulence>> parts_;
};

}  // namespace skein::environment
