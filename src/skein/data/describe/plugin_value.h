// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/data/describe/wire.h"
#include "skein/data/event/plugin_record.h"
#include "skein/data/radio/message.h"

namespace skein {

/// A plugin's own described value, coded as Skein carries it.
template <class T>
std::vector<std::uint8_t> to_coded(const T& value) {
  std::vector<std::byte> bytes;
  wire::encode(value, bytes);
  std::vector<std::uint8_t> coded;
  for (const std::byte b : bytes) coded.push_back(std::to_integer<std::uint8_t>(b));
  return coded;
}

/// A plugin's own value as the content of a message.
/// @param kind  what it is; starts with the plugin's name.
template <class T>
PluginPayload to_payload(std::string kind, const T& value) {
  return {std::move(kind), to_coded(value)};
}

/// A plugin's own value as a record.
template <class T>
PluginRecord to_record(Time time, std::string kind, const T& value) {
  return {time, std::move(kind), to_coded(value)};
}

/// The value that was coded. Whether it is a T, its `kind` says.
/// Fails: kBadInput when the bytes are no T.
template <class T>
Result<T> from_coded(const std::vector<std::uint8_t>& coded) {
  return wire::decode<T>(std::as_bytes(std::span(coded)));
}

}  // namespace skein
