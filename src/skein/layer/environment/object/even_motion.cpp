// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/object/even_motion.h"

namespace skein::environment {

void EvenMotion::advance(const ObjectView& view) {
  now_ = view.now;
}

Vec2 EvenMotion::position() const {
  return begin_ + now_.seconds() * velocity_;
}

}  // namespace skein::environment
