// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

/// What a parallel loop promises about memory, said to the thread sanitizer: all before
/// the loop happens before each of its tasks, and these before all after the loop. The
/// library that runs the loop keeps that, but is not built with the sanitizer. Without
/// the sanitizer all of this is nothing.
namespace skein::simulation::fork_join {

#if defined(__SANITIZE_THREAD__)
// Marks without content; global, because a task may not touch its own closure before
// begin_task().
inline char forked, joined;
inline void fork() {
  __tsan_release(&forked);
}
inline void begin_task() {
  __tsan_acquire(&forked);
}
inline void end_task() {
  __tsan_release(&joined);
}
inline void join() {
  __tsan_acquire(&joined);
}
#else
inline void fork() {}
inline void begin_task() {}
inline void end_task() {}
inline void join() {}
#endif

}  // namespace skein::simulation::fork_join
