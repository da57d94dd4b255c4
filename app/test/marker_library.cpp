// SPDX-License-Identifier: Apache-2.0
// A shared library whose code runs as soon as it is loaded: it leaves the file that the
// variable SKEIN_MARKER names. It is no plugin.
#include <cstdio>
#include <cstdlib>

namespace {

__attribute__((constructor)) void leave_marker() {
  const char* name = std::getenv("SKEIN_MARKER");
  if (name == nullptr) return;
  if (std::FILE* file = std::fopen(name, "w")) std::fclose(file);
}

}  // namespace
