// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <csignal>
#include <cstdint>

#include "app/test/program.h"

namespace skein::app {
namespace {

// A heartbeat of system 42, as another implementation writes it.
const std::string kHeartbeat(
    "\xfd\x09\x00\x00\x4d\x2a\xbf\x00\x00\x00\x28\x91\x21\xfe\x7a\xd1\x03\x0b\x03\x62"
    "\x90",
    21);

sockaddr_in local(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

int connected(int kind, int port) {
  const int socket = ::socket(AF_INET, kind, 0);
  const sockaddr_in address = local(port);
  EXPECT_EQ(connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address),
            0);
  const timeval patience{10, 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  return socket;
}

// The port after `text` in what the program has said, once it says so.
int port_after(const fs::path& file, const std::string& text) {
  for (int k = 0; k < 1000; ++k) {
    const std::string said = read_file(file);
    const std::size_t at = said.find(text);
    if (at != std::string::npos && said.find('\n', at) != std::string::npos)
      return std::atoi(said.c_str() + at + text.size());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << text << " is not said";
  return 0;
}

TEST_F(Program, HandsMavlinkOnAndRecordsIt) {
  const pid_t link = start({"link", "udpin:0", "tcpin:0", "--tlog", "flight.tlog"});
  const int station =
      connected(SOCK_STREAM, port_after(folder_ / "err.txt", "at tcpin:127.0.0.1:"));
  port_after(folder_ / "err.txt", "is open");
  const int vehicle =
      connected(SOCK_DGRAM, port_after(folder_ / "err.txt", "at udpin:127.0.0.1:"));
  EXPECT_EQ(send(vehicle, kHeartbeat.data(), kHeartbeat.size(), 0), 21);
  std::string heard(64, '\0');
  const ssize_t count = recv(station, heard.data(), heard.size(), 0);
  EXPECT_EQ(heard.substr(0, static_cast<std::size_t>(std::max<ssize_t>(count, 0))),
            kHeartbeat);
  kill(link, SIGINT);
  const Finished done = finish(link);
  close(station);
  close(vehicle);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find(" 42 "), std::string::npos) << done.out;
  const std::string tlog = read_file(folder_ / "flight.tlog");
  ASSERT_EQ(tlog.size(), 8 + kHeartbeat.size());
  EXPECT_EQ(tlog.substr(8), kHeartbeat);
}

TEST_F(Program, ALinkDoesNotReplaceARecordUnasked) {
  write("flight.tlog", "precious");
  const Finished refused =
      run({"link", "udpin:0", "--for", "0.1", "--tlog", "flight.tlog"});
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.err.find("exists already"), std::string::npos);
  EXPECT_EQ(read_file(folder_ / "flight.tlog"), "precious");
  EXPECT_EQ(
      run({"link", "udpin:0", "--for", "0.1", "--tlog", "flight.tlog", "--overwrite"})
          .status,
      0);
  EXPECT_EQ(read_file(folder_ / "flight.tlog"), "");
}

TEST_F(Program, ALinkSaysWhatIsWrongWithAnEndpoint) {
  const Finished refused = run({"link", "udpin:0", "tcp:host"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("a host and a port are wanted"), std::string::npos);
}

}  // namespace
}  // namespace skein::app
