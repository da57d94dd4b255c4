// SPDX-License-Identifier: Apache-2.0
#include "skein/base/check.h"

namespace skein::detail {

void fail_check(const char* condition, const char* file, int line,
                const std::string& values) {
  throw Bug(fmt::format("{}:{}: check failed: {}{}{}", file, line, condition,
                        values.empty() ? "" : " with", values));
}

}  // namespace skein::detail
