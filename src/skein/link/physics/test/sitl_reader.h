// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skein::physics {

/// Reads lines as SITL 4.5 does: by looking for names. The text between the last two ends
/// of lines counts; a name is looked for behind that of its section, anywhere; its value
/// begins right behind `":`. Stricter than SITL in that each name must be in quotes.
class SitlReader {
 public:
  using Values = std::map<std::string, std::vector<double>>;

  /// What has come in a datagram, after those before; none without a whole line, or
  /// without a value that is needed.
  std::optional<Values> read(std::string_view datagram) {
    held_ += datagram;
    const std::size_t end = held_.rfind('\n');
    if (end == std::string::npos || end == 0) return std::nullopt;
    const std::size_t begin = held_.rfind('\n', end - 1);
    if (begin == std::string::npos) return std::nullopt;
    const std::string line = held_.substr(begin + 1, end - begin - 1);
    held_.erase(0, end);
    return values_in(line);
  }

 private:
  struct Key {
    const char* section;
    const char* name;
    std::size_t count;
    bool needed;
  };

  static std::optional<Values> values_in(const std::string& line) {
    static constexpr Key kKeys[] = {
        {"", "timestamp", 1, true},      {"imu", "gyro", 3, true},
        {"imu", "accel_body", 3, true},  {"", "position", 3, true},
        {"", "velocity", 3, true},       {"", "attitude", 3, false},
        {"", "quaternion", 4, false},    {"", "rng_1", 1, false},
        {"", "rng_2", 1, false},         {"windvane", "direction", 1, false},
        {"windvane", "speed", 1, false}, {"", "airspeed", 1, false},
        {"", "no_time_sync", 1, false},  {"", "latitude", 1, false},
        {"rc", "rc_1", 1, false},        {"battery", "voltage", 1, false},
        {"battery", "current", 1, false}};
    Values values;
    for (const Key& key : kKeys) {
      auto found = value_of(line, key);
      if (found)
        values[key.name] = *found;
      else if (key.needed)
        return std::nullopt;
    }
    if (values.count("quaternion") + values.count("attitude") == 0) return std::nullopt;
    return values;
  }

  static std::optional<std::vector<double>> value_of(const std::string& line,
                                                     const Key& key) {
    const std::size_t section = line.find(key.section);
    if (section == std::string::npos) return std::nullopt;
    const std::string name(key.name);
    const std::size_t at = line.find(name, section + std::string(key.section).size());
    if (at == std::string::npos || at == 0 || line[at - 1] != '"') return std::nullopt;
    const char* value = line.c_str() + at + name.size();
    if (std::string_view(value).substr(0, 2) != "\":") return std::nullopt;
    value += 2;
    if (key.count > 1 && *value++ != '[') return std::nullopt;
    std::vector<double> numbers;
    while (numbers.size() < key.count) {
      if (!numbers.empty() && *value++ != ',') return std::nullopt;
      char* after = nullptr;
      // A space is only allowed behind a comma.
      if (numbers.empty() && *value == ' ') return std::nullopt;
      numbers.push_back(std::strtod(value, &after));
      if (after == value) return std::nullopt;
      value = after;
    }
    if (key.count > 1 && *value != ']') return std::nullopt;
    return numbers;
  }

  std::string held_;
};

}  // namespace skein::physics
