// SPDX-License-Identifier: Apache-2.0
// How many datagrams a relay passes, and what that costs: a sender at a given rate, the
// relay in a thread of its own, a receiver, all on this machine.
//
//   bench_relay [SECONDS]
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "skein/link/relay/relay.h"

namespace {

using namespace skein;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kBytes = 200;  // of a datagram

sockaddr_in local(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

double thread_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

int bound_socket(std::uint16_t& port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  const int room = 8 << 20;
  setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  const timeval patience{0, 100'000};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in address = local(0);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (::bind(socket, generic, size) != 0) std::abort();
  getsockname(socket, generic, &size);
  port = ntohs(address.sin_port);
  return socket;
}

// Sends at a rate, in bursts of a millisecond; returns how many.
std::uint64_t send_at(double rate, double seconds, std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  const sockaddr_in to = local(port);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
    std::abort();
  const std::vector<char> packet(kBytes);
  const auto begin = Clock::now();
  std::uint64_t sent = 0;
  while (true) {
    const double now = std::chrono::duration<double>(Clock::now() - begin).count();
    if (now >= seconds) break;
    for (; static_cast<double>(sent) < rate * now; ++sent)
      ::send(socket, packet.data(), packet.size(), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::close(socket);
  return sent;
}

void measure(const char* what, const impairment::Impairment& impairment, double rate,
             double seconds) {
  relay::RelayOptions options;
  options.listen = transport::UdpServer{};
  std::uint16_t target = 0;
  const int receiver = bound_socket(target);
  options.to = {"127.0.0.1", target};
  options.plan.first = {impairment, impairment};
  auto opened = relay::Relay::open(options, [](const std::string&) {});
  if (!opened) std::abort();
  relay::Relay& relay = *opened.value();
  const std::string place = relay.place();
  const auto port =
      static_cast<std::uint16_t>(std::stoi(place.substr(place.rfind(':') + 1)));

  std::atomic<bool> over = false;
  double cpu = 0;
  std::thread relaying([&] {
    while (!over) relay.run_for(std::chrono::milliseconds(50));
    cpu = thread_cpu_s();
  });
  std::uint64_t came = 0;
  std::thread receiving([&] {
    std::vector<char> packet(65'536);
    while (!over)
      if (::recv(receiver, packet.data(), packet.size(), 0) > 0) ++came;
  });
  const std::uint64_t sent = send_at(rate, seconds, port);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  over = true;
  relaying.join();
  receiving.join();
  ::close(receiver);
  const auto counts =
      relay.report().directions[index_of(impairment::Direction::kToB)].counts;
  fmt::print("{:<28} {:>9.0f} {:>9.0f} {:>9.0f} {:>8.1f} {:>8.2f} {:>9.3f} {:>8.2f}\n",
             what, static_cast<double>(sent) / seconds,
             static_cast<double>(counts.packets_in) / seconds,
             static_cast<double>(came) / seconds, 100 * cpu / seconds,
             1e6 * cpu / static_cast<double>(counts.packets_in),
             1e3 * counts.delay_mean(), 1e3 * counts.delay_max.seconds());
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 5;
  if (!(seconds > 0)) return 2;
  fmt::print("{:<28} {:>9} {:>9} {:>9} {:>8} {:>8} {:>9} {:>8}\n", "", "sent/s", "in/s",
             "out/s", "CPU [%]", "us each", "mean [ms]", "max [ms]");
  impairment::Impairment delayed;
  delayed.delay = 0.1;
  impairment::Impairment bad = delayed;
  bad.jitter = 0.02;
  bad.loss = 0.1;
  bad.duplicate = 0.02;
  for (const double rate : {1000.0, 10'000.0, 50'000.0, 200'000.0}) {
    measure("nothing", {}, rate, seconds);
    measure("a delay of 100 ms", delayed, rate, seconds);
    measure("and jitter, loss, doubles", bad, rate, seconds);
  }
  return 0;
}
