// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein::serve {

/// Where and to whom a run is served.
struct ServeOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;     ///< 0: any that is free
  std::string tokens_file;       ///< empty: everybody on this machine may do everything
  std::string certificate_file;  ///< empty: without TLS
  std::string key_file;
  /// Names by which others reach this machine: "ground.example.org".
  std::vector<std::string> hosts;
  /// Pages of other servers that may watch by Foxglove's protocol, by their origins:
  /// "https://app.example.org".
  std::vector<std::string> viewer_origins;
  std::string imagery;  ///< address of pictures of the ground, {z} {x} {y}; empty: none
};

/// Reads where a page is served: "8080", "0.0.0.0:8080" or "[::1]:8080".
/// Fails: kBadInput for anything else.
Result<void> read_place(const std::string& text, ServeOptions& options);

}  // namespace skein::serve
