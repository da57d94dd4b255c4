// SPDX-License-Identifier: Apache-2.0
#include "skein/link/transport/endpoint_address.h"

#include <gtest/gtest.h>

#include <string>

#include "skein/link/transport/endpoints.h"

namespace skein::transport::endpoint_address_test {
namespace {

TEST(EndpointAddress, IsReadAndWrittenTheSame) {
  for (const char* text :
       {"udpin:0.0.0.0:14550", "udpout:gcs.example:14550", "udpbcast:10.0.0.255:14550",
        "tcpin:127.0.0.1:5760", "tcp:127.0.0.1:5760", "serial:/dev/ttyACM0:115200",
        "udpmulti:239.1.2.3:14600:127.0.0.1"}) {
    const auto address = parse_endpoint(text);
    ASSERT_TRUE(address.ok()) << address.error().text();
    EXPECT_EQ(text_of(address.value()), text);
  }
}

TEST(EndpointAddress, LetsOnlyTheSameMachineInWhereNothingElseIsSaid) {
  EXPECT_EQ(text_of(parse_endpoint("udpin:14550").value()), "udpin:127.0.0.1:14550");
  EXPECT_EQ(text_of(parse_endpoint("tcpin:0").value()), "tcpin:127.0.0.1:0");
  EXPECT_EQ(text_of(parse_endpoint("udpmulti:239.1.2.3:14600").value()),
            "udpmulti:239.1.2.3:14600:127.0.0.1");
  EXPECT_EQ(text_of(parse_endpoint("serial:/dev/ttyUSB0").value()),
            "serial:/dev/ttyUSB0:57600");
}

TEST(EndpointAddress, SaysWhatIsWrong) {
  for (const auto& [text, what] : {std::pair{"udp:1.2.3.4:5", "\"udp\" is no kind"},
                                   {"", "\"\" is no kind"},
                                   {"udpout:14550", "a host and a port"},
                                   {"udpout::14550", "the host is empty"},
                                   {"tcp:host:0", "\"0\" is no port from 1"},
                                   {"tcpin:70000", "no port from 0"},
                                   {"tcp:host:5x", "\"5x\" is no port"},
                                   {"udpmulti:10.0.0.1:5", "\"10.0.0.1\" is no address"},
                                   {"udpmulti:239.1.1.1", "a host and a port"},
                                   {"udpmulti:239.1.1.1:5:", "the interface is empty"},
                                   {"udpmulti:239.1.1.1:5:[::1]", "IPv4 address"},
                                   {"udpout:::1:5", "in brackets"},
                                   {"tcp:[::1:5", "in brackets"},
                                   {"serial:", "a device is wanted"},
                                   {"serial:/dev/ttyS0:fast", "\"fast\" is no rate"}}) {
    const auto address = parse_endpoint(text);
    ASSERT_FALSE(address.ok()) << text;
    EXPECT_NE(address.error().text().find(what), std::string::npos)
        << address.error().text();
    EXPECT_NE(address.error().text().find("udpbcast:ADDRESS:PORT"), std::string::npos);
  }
}

TEST(EndpointAddress, IsLocalOnLoopbackAddressesAndPseudoTerminals) {
  const auto local = [](const char* text) {
    return is_local(parse_endpoint(text).value());
  };
  for (const char* text :
       {"udpin:14550", "udpin:127.0.0.1:14550", "udpout:127.0.0.1:14550",
        "udpout:localhost:14550", "tcpin:5760", "tcp:127.1.2.3:5760", "udpin:[::1]:14550",
        "udpout:[::1]:14550", "tcp:[::ffff:127.0.0.1]:5760",
        "udpmulti:239.1.1.1:14550:127.0.0.2"})
    EXPECT_TRUE(local(text)) << text;
  for (const char* text :
       {"udpin:0.0.0.0:14550", "udpout:10.0.0.2:14550", "tcpin:0.0.0.0:5760",
        "tcp:autopilot:5760", "udpbcast:10.0.0.255:14550", "serial:/dev/ttyS99",
        "udpin:[::]:14550", "tcp:[fe80::1]:5760", "udpout:[::ffff:10.0.0.2]:14550",
        "udpmulti:239.1.1.1:14550:10.0.0.2"})
    EXPECT_FALSE(local(text)) << text;
  // As servers name their peers.
  EXPECT_TRUE(is_local_channel("udpin:0.0.0.0:14550 from 127.0.0.1:40000"));
  EXPECT_TRUE(is_local_channel("udpin:[::]:14550 from [::1]:40000"));
  EXPECT_TRUE(is_local_channel("udpin:[::]:14550 from [::ffff:127.0.0.1]:40000"));
  EXPECT_FALSE(is_local_channel("udpin:[::1]:1 from [::ffff:10.0.0.2]:40000"));
  EXPECT_FALSE(is_local_channel("udpin:0.0.0.0:14550 from 10.0.0.2:40000"));
  EXPECT_FALSE(is_local_channel("tcpin:127.0.0.1:1 from 10.127.0.1:127"));
  EXPECT_FALSE(is_local_channel("no endpoint"));
}

}  // namespace
}  // namespace skein::transport::endpoint_address_test
