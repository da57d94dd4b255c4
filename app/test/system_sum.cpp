// SPDX-License-Identifier: Apache-2.0
// Prints a checksum of the system's elementary functions, which shows the variants that
// its library has chosen.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>

int main() {
  std::uint64_t sum = 0;
  for (int i = 1; i < 20'000; ++i) {
    const volatile double x = 1e-3 * i;
    for (const double value :
         {std::sin(x), std::exp(x), std::log(x), std::pow(x, 1.37), std::atan(x)})
      sum = sum * 31 + std::bit_cast<std::uint64_t>(value);
  }
  std::printf("%llx\n", static_cast<unsigned long long>(sum));
}
