// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "skein/base/result.h"
#include "skein/link/physics/ardupilot_json.h"

namespace skein::physics {

/// Where instance n of SITL looks for its physics: 9002 + 10 n.
constexpr std::uint16_t ardupilot_port(int instance) {
  return static_cast<std::uint16_t>(9002 + 10 * instance);
}

/// What has happened at a backend since it was opened.
struct BackendCounts {
  std::uint64_t steps = 0;     ///< frames handed out
  std::uint64_t restarts = 0;  ///< of the program, after its first start
  std::uint64_t repeats = 0;   ///< answers sent once more
  std::uint64_t missed = 0;    ///< frames that never came, by their counts
  std::uint64_t ignored = 0;   ///< datagrams that are no frame, or another program's
  std::string last_ignored;    ///< why the last of these was
};

/// The physics side of one SITL: it waits for each answer, so it goes as fast as the
/// simulation does.
///
///   while (world goes on) {
///     if (const auto servos = backend.wait(patience)) {
///       move the aircraft by a step;
///       backend.reply(its motion);
///     }  // else: nobody there, or too slow; the world may go on and ask again
///   }
///
/// Threads: one at a time may call; the calls block that thread only. Backends share
/// nothing, each may have a thread of its own.
///
/// A program that starts again is followed at once from the same port, and from another
/// port as soon as the one before has let wait() wait for 1.5 s (or forget_program() was
/// called). Until then the frames of another program count as ignored: two with the same
/// instance number do not mix.
class ArduPilotBackend {
 public:
  /// @param port     see ardupilot_port(); 0: any free one.
  /// @param address  of this machine, IPv4; 0.0.0.0 lets other machines in.
  /// Fails: kBadInput for a text that is no address, kUnavailable for a place that is
  ///        taken.
  static Result<ArduPilotBackend> open(std::uint16_t port,
                                       const std::string& address = "127.0.0.1");

  std::uint16_t port() const;

  /// Waits for the next step that the program asks for. Frames that it repeats because an
  /// answer was lost are answered from here.
  /// @returns  none after `patience` without one. A frame that was not answered is handed
  ///           out again when the program repeats it.
  std::optional<ServoFrame> wait(std::chrono::milliseconds patience);

  /// Answers the frame that wait() has handed out last; once.
  /// Fails: kBadInput for a number that is not finite, kUnavailable when nothing can be
  ///        sent; the frame stays unanswered then. Bug without a frame to answer.
  Result<void> reply(const PhysicsFrame& frame);

  /// Whoever started the program has ended it: the next one is followed at once. Bytes
  /// that have come up to now are passed over.
  void forget_program();

  const BackendCounts& counts() const { return counts_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Peer {
    std::uint32_t address = 0;
    std::uint16_t port = 0;
    bool operator==(const Peer&) const = default;
  };

  // Closes itself.
  class Socket {
   public:
    explicit Socket(int fd) : fd_(fd) {}
    Socket(Socket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Socket& operator=(Socket&& other) noexcept {
      std::swap(fd_, other.fd_);
      return *this;
    }
    ~Socket();
    int fd() const { return fd_; }

   private:
    int fd_;
  };

  explicit ArduPilotBackend(int socket) : socket_(socket) {}
  // Reads what has come; the frame to hand out, if there is one.
  std::optional<ServoFrame> read_all();
  bool is_from_program(const Peer& from);
  void begin_anew();
  void ignore(std::string why);
  bool send_answer() const;

  Socket socket_;
  std::optional<Peer> program_;
  ServoFollower follower_;
  std::uint64_t missed_before_ = 0;  // by programs that have ended
  Clock::duration silence_{};        // waited since the program's last frame
  bool unanswered_ = false;          // a frame is handed out
  std::string answer_;               // the last one; empty: none yet
  Clock::time_point answered_;
  BackendCounts counts_;
};

}  // namespace skein::physics
