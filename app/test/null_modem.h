// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

namespace skein::app {

/// Two serial lines that are joined: what goes into one comes out of the other.
class NullModem {
 public:
  NullModem() {
    for (std::size_t k = 0; k < 2; ++k) {
      master_[k] = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
      termios raw{};
      const bool made = master_[k] >= 0 && grantpt(master_[k]) == 0 &&
                        unlockpt(master_[k]) == 0 && tcgetattr(master_[k], &raw) == 0;
      if (!made) return;
      cfmakeraw(&raw);
      tcsetattr(master_[k], TCSANOW, &raw);
      name_[k] = ptsname(master_[k]);
      // Held open, so that the line stays when a program leaves it.
      held_[k] = open(name_[k].c_str(), O_RDWR | O_NOCTTY);
    }
    pump_ = std::thread([this] {
      while (!stop_) turn();
    });
  }
  ~NullModem() {
    stop_ = true;
    if (pump_.joinable()) pump_.join();
    for (const int each : {held_[0], held_[1], master_[0], master_[1]})
      if (each >= 0) close(each);
  }
  NullModem(const NullModem&) = delete;
  NullModem& operator=(const NullModem&) = delete;

  /// Device of one end, 0 or 1; empty: this machine has no such lines.
  const std::string& name(std::size_t end) const { return name_.at(end); }

  /// Spoils one of so many bytes from now on; 0: none.
  void spoil_each(int bytes) { spoil_each_ = bytes; }

 private:
  void turn() {
    std::array<pollfd, 2> ends = {{{master_[0], POLLIN, 0}, {master_[1], POLLIN, 0}}};
    if (poll(ends.data(), ends.size(), 20) <= 0) return;
    for (std::size_t k = 0; k < 2; ++k) {
      std::array<char, 512> bytes{};
      const ssize_t count = read(master_[k], bytes.data(), bytes.size());
      for (ssize_t n = 0; n < count; ++n)
        if (spoil_each_ > 0 && ++passed_ % spoil_each_ == 0)
          bytes[static_cast<std::size_t>(n)] ^= 0x10;
      if (count > 0 &&
          write(master_[1 - k], bytes.data(), static_cast<std::size_t>(count)) < 0)
        return;
    }
  }

  std::array<int, 2> master_ = {-1, -1}, held_ = {-1, -1};
  std::array<std::string, 2> name_;
  std::atomic<bool> stop_ = false;
  std::atomic<int> spoil_each_ = 0;
  int passed_ = 0;
  std::thread pump_;
};

}  // namespace skein::app
