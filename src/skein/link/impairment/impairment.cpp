// SPDX-License-Identifier: Apache-2.0
#include "skein/link/impairment/impairment.h"

namespace skein::impairment {
namespace {

template <class T>
void take_over(const std::optional<T>& from, T& to) {
  if (from) to = *from;
}

}  // namespace

void apply(const ImpairmentChange& change, Impairment& to) {
  take_over(change.delay, to.delay);
  take_over(change.jitter, to.jitter);
  take_over(change.jitter_kind, to.jitter_kind);
  take_over(change.loss, to.loss);
  take_over(change.duplicate, to.duplicate);
  take_over(change.reorder, to.reorder);
  take_over(change.reorder_delay, to.reorder_delay);
  take_over(change.rate, to.rate);
  take_over(change.queue_bytes, to.queue_bytes);
  take_over(change.cut, to.cut);
}

}  // namespace skein::impairment
