// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/ardupilot_backend.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace skein::physics {
namespace {

using namespace std::chrono_literals;

constexpr auto kGone = 1500ms;  // a silent program is, for another one
// SITL repeats a frame after one second. One that is read sooner after the answer has
// passed it on the way: a second answer would be taken for that to the next frame.
constexpr auto kCrossed = 500ms;
constexpr int kMaxDatagrams = 64;   // between two looks at the clock
constexpr int kMaxQueued = 10'000;  // more than the system holds

Error socket_error(const std::string& place, int error) {
  return {ErrorCode::kUnavailable, place, fmt::format("{}.", std::strerror(error)), ""};
}

sockaddr* any_address(sockaddr_in& address) {
  return reinterpret_cast<sockaddr*>(&address);
}

}  // namespace

Result<ArduPilotBackend> ArduPilotBackend::open(std::uint16_t port,
                                                const std::string& address) {
  const std::string place = fmt::format("{}:{}", address, port);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  if (::inet_pton(AF_INET, address.c_str(), &at.sin_addr) != 1)
    return Error{ErrorCode::kBadInput, place, "this is no IPv4 address.", ""};
  ArduPilotBackend backend(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const int socket = backend.socket_.fd();
  if (socket < 0 || ::bind(socket, any_address(at), sizeof at) != 0)
    return socket_error(place, errno);
  return backend;
}

ArduPilotBackend::Socket::~Socket() {
  if (fd_ >= 0) ::close(fd_);
}

std::uint16_t ArduPilotBackend::port() const {
  sockaddr_in at{};
  socklen_t size = sizeof at;
  ::getsockname(socket_.fd(), any_address(at), &size);
  return ntohs(at.sin_port);
}

std::optional<ServoFrame> ArduPilotBackend::wait(std::chrono::milliseconds patience) {
  const Clock::time_point until = Clock::now() + patience;
  for (;;) {
    if (auto frame = read_all()) return frame;
    const Clock::time_point before = Clock::now();
    if (before >= until) return std::nullopt;
    pollfd ready{socket_.fd(), POLLIN, 0};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - before);
    ::poll(&ready, 1, static_cast<int>(std::min<std::int64_t>(left.count(), 60'000)));
    silence_ += Clock::now() - before;
  }
}

std::optional<ServoFrame> ArduPilotBackend::read_all() {
  std::optional<ServoFrame> step;
  bool repeated = false;
  for (int k = 0; k < kMaxDatagrams; ++k) {
    std::array<std::byte, 128> datagram;  // a longer one is cut, and then is no frame
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t got = ::recvfrom(socket_.fd(), datagram.data(), datagram.size(),
                                   MSG_DONTWAIT, any_address(from), &size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) break;
    const auto frame =
        parse_servo_frame(std::span(datagram).first(static_cast<std::size_t>(got)));
    if (!frame) {
      ignore(frame.error().message);
      continue;
    }
    if (!is_from_program({from.sin_addr.s_addr, from.sin_port})) continue;
    const ServoStep what = follower_.take(frame.value().frame_count);
    if (what == ServoStep::kBegin && counts_.steps > 0) ++counts_.restarts;
    // Of several the last one counts: the program does not wait for those before.
    if (what == ServoStep::kRepeat && !unanswered_ && !step)
      repeated = true;
    else
      step = frame.value();
  }
  counts_.missed = missed_before_ + follower_.missed();
  if (step) {
    unanswered_ = true;
    ++counts_.steps;
  } else if (repeated && Clock::now() - answered_ >= kCrossed && send_answer()) {
    answered_ = Clock::now();
    ++counts_.repeats;
  }
  return step;
}

bool ArduPilotBackend::is_from_program(const Peer& from) {
  if (program_ && program_ != from) {
    if (silence_ < kGone) {
      ignore(
          fmt::format("port {} sends too; it is another program's, with the same "
                      "instance number.",
                      ntohs(from.port)));
      return false;
    }
    begin_anew();
  }
  program_ = from;
  silence_ = {};
  return true;
}

void ArduPilotBackend::begin_anew() {
  missed_before_ += follower_.missed();
  follower_ = {};
  unanswered_ = false;
}

void ArduPilotBackend::forget_program() {
  std::byte first;
  for (int k = 0; k < kMaxQueued; ++k)
    if (::recv(socket_.fd(), &first, 1, MSG_DONTWAIT) < 0 && errno != EINTR) break;
  program_.reset();
  begin_anew();
}

void ArduPilotBackend::ignore(std::string why) {
  ++counts_.ignored;
  counts_.last_ignored = std::move(why);
}

Result<void> ArduPilotBackend::reply(const PhysicsFrame& frame) {
  SKEIN_CHECK(unanswered_);
  if (auto written = write_json(frame, answer_); !written) return written;
  if (!send_answer())
    return socket_error(fmt::format("port {}", ntohs(program_->port)), errno);
  unanswered_ = false;
  answered_ = Clock::now();
  return {};
}

bool ArduPilotBackend::send_answer() const {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_addr.s_addr = program_->address;
  to.sin_port = program_->port;
  return ::sendto(socket_.fd(), answer_.data(), answer_.size(), MSG_DONTWAIT,
                  any_address(to), sizeof to) == static_cast<ssize_t>(answer_.size());
}

}  // namespace skein::physics
