// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/network/network_tables.h"

#include <gtest/gtest.h>

namespace skein::exchange::network_tables_test {
namespace {

std::string refusal_of_nodes(const std::string& text) {
  NetworkCase network;
  const auto read = read_network_nodes(text, "n.csv", network);
  return read ? std::string("accepted") : read.error().text();
}

TEST(NetworkTables, NodesMoveOnStraightLines) {
  NetworkCase network;
  const auto read = read_network_nodes(
      "power_dbm,node,time_s,x_m,y_m,z_m\n"
      ",7,0,1,2,3\n"
      "4,2,1,0,0,50\n"
      "4,2,11,100,-50,50\n",
      "n.csv", network);
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(network.names, (std::vector<std::uint32_t>{2, 7}));
  const NodeTrack& moving = network.nodes[0];
  EXPECT_EQ(moving.transmit_power_dbm, 4);
  EXPECT_EQ(moving.place(Time()), Vec3(0, 0, -50));
  EXPECT_EQ(moving.place(Time::from_seconds(6)), Vec3(50, -25, -50));
  EXPECT_EQ(moving.place(Time::from_seconds(99)), Vec3(100, -50, -50));
  EXPECT_FALSE(network.nodes[1].moves());
  EXPECT_EQ(network.nodes[1].place(Time::from_seconds(3)), Vec3(1, 2, -3));
  EXPECT_FALSE(network.nodes[1].transmit_power_dbm);
}

TEST(NetworkTables, SayWhatIsWrongWithNodes) {
  const std::string head = "node,time_s,x_m,y_m,z_m,power_dbm\n";
  EXPECT_NE(refusal_of_nodes("").find("the table is empty"), std::string::npos);
  EXPECT_NE(refusal_of_nodes(head).find("there is no node"), std::string::npos);
  EXPECT_NE(refusal_of_nodes(head + "1,0,1,2,3\n").find("n.csv:2: 5 cells"),
            std::string::npos);
  EXPECT_NE(refusal_of_nodes(head + "-1,0,1,2,3,\n").find("\"node\": \"-1\" is no whole"),
            std::string::npos);
  EXPECT_NE(
      refusal_of_nodes(head + "1,0,1,nan,3,\n").find("\"y_m\": \"nan\" is no number"),
      std::string::npos);
  EXPECT_NE(refusal_of_nodes(head + "1,5,1,1,3,\n1,5,2,2,2,\n")
                .find("n.csv:3: column \"time_s\": the rows"),
            std::string::npos);
  EXPECT_NE(refusal_of_nodes(head + "1,5,1,1,3,4\n1,6,2,2,2,5\n")
                .find("\"power_dbm\": differs"),
            std::string::npos);
  EXPECT_NE(refusal_of_nodes("node,time_s,x_m,y_m\n").find("column \"z_m\" is missing"),
            std::string::npos);
}

TEST(NetworkTables, TrafficKnowsItsNodes) {
  NetworkCase network;
  ASSERT_TRUE(read_network_nodes("node,time_s,x_m,y_m,z_m\n4,0,0,0,0\n8,0,1,0,0\n", "n",
                                 network));
  const auto read = read_network_traffic(
      "message,time_s,from,to,bytes\n10,0.000000001,8,4,0\n11,2.5,4,*,65000\n", "t.csv",
      network);
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(network.traffic.size(), 2u);
  EXPECT_EQ(network.traffic[0].time.ns(), 1);
  EXPECT_EQ(network.traffic[0].from, 1u);
  EXPECT_EQ(network.traffic[1].to, kAllNodesOfCase);
  const auto refusal = [&](const std::string& rows) {
    const auto bad =
        read_network_traffic("message,time_s,from,to,bytes\n" + rows, "t.csv", network);
    return bad ? std::string("accepted") : bad.error().text();
  };
  EXPECT_NE(refusal("1,3,4,8,1\n2,2,4,8,1\n")
                .find("t.csv:3: column \"time_s\": the rows are in order"),
            std::string::npos);
  EXPECT_NE(refusal("1,3,4,8,1\n1,4,4,8,1\n").find("message 1 is there twice"),
            std::string::npos);
  EXPECT_NE(refusal("1,3,5,8,1\n").find("there is no node 5"), std::string::npos);
}

TEST(NetworkTables, FlowsAreNumbers) {
  NetworkCase network;
  ASSERT_TRUE(read_network_nodes("node,time_s,x_m,y_m,z_m\n4,0,0,0,0\n8,0,1,0,0\n", "n",
                                 network));
  const auto flow = parse_saturated_flow("8,4,1000,5,0.25", network);
  ASSERT_TRUE(flow.ok()) << flow.error().text();
  EXPECT_EQ(flow.value().from, 1u);
  EXPECT_EQ(flow.value().depth, 5u);
  EXPECT_EQ(flow.value().start.ns(), 250'000'000);
  for (const char* text : {"", "8", "8,4,1000,0", "8,8,1000,5", "8,4,1e9,5", "8,4,10,5,x",
                           "8.5,4,10,5", "8,4,10,5,1,2"})
    EXPECT_FALSE(parse_saturated_flow(text, network).ok()) << text;
}

TEST(NetworkTables, Ns2MovementsEndWhereTheNextBegins) {
  NetworkCase network;
  const auto read = read_ns2_movement(
      "# made by hand\n"
      "$node_(1) set X_ 10\r\n"
      "$node_(1) set Z_ 30\n"
      "\n"
      "$ns_ at 1 \"$node_(1) setdest 110 0 10\"\n"
      "$ns_ at 6 \"$node_(1) setdest 60 100 20\"\n",
      "m.ns2", network);
  ASSERT_TRUE(read.ok()) << read.error().text();
  const NodeTrack& track = network.nodes[0];
  EXPECT_EQ(track.place(Time::from_seconds(1)), Vec3(10, 0, -30));
  EXPECT_EQ(track.place(Time::from_seconds(6)), Vec3(60, 0, -30));
  EXPECT_EQ(track.place(Time::from_seconds(11)), Vec3(60, 100, -30));
  for (const char* bad :
       {"$node_(1) set W_ 3\n", "set god_ [God instance]\n", "$node_(x) set X_ 3\n",
        "$ns_ at 1\n", "$ns_ at -1 \"$node_(1) setdest 1 2 3\"\n",
        "$ns_ at -1 \"$node_(1) set X_ 1\"\n", "$ns_ at 1 \"$node_(1) set W_ 1\"\n", ""})
    EXPECT_FALSE(read_ns2_movement(bad, "m.ns2", network).ok()) << bad;
}

// As ns-2's own setdest writes it, with pauses. Its $god_ lines, distances in hops, say
// nothing that does not follow from the places: other simulators skip them too.
TEST(NetworkTables, Ns2FilesOfSetdestAreRead) {
  NetworkCase network;
  const auto read = read_ns2_movement(
      "#\n# nodes: 2, pause: 2.00, max speed: 10.00, max x: 500.00, max y: 500.00\n#\n"
      "$node_(0) set X_ 83.500000000000\n"
      "$node_(0) set Y_ 239.000000000000\n"
      "$node_(0) set Z_ 0.000000000000\n"
      "$node_(1) set X_ 257.000000000000\n"
      "$node_(1) set Y_ 345.000000000000\n"
      "$node_(1) set Z_ 0.000000000000\n"
      "$god_ set-dist 0 1 1\n"
      "$ns_ at 2.000000000000 \"$node_(0) setdest 83.500000000000 139.000000000000 "
      "10.000000000000\"\n"
      "$ns_ at 9.641000000000 \"$god_ set-dist 0 1 16777215\"\n"
      "$ns_ at 12.000000000000 \"$node_(0) setdest 83.500000000000 139.000000000000 "
      "0.000000000000\"\n"
      "#\n# Destination Unreachables: 1\n#\n",
      "m.ns2", network);
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(network.nodes.size(), 2u);
  EXPECT_EQ(network.nodes[0].place(Time::from_seconds(2)), Vec3(83.5, 239, 0));
  EXPECT_EQ(network.nodes[0].place(Time::from_seconds(7)), Vec3(83.5, 189, 0));
  EXPECT_EQ(network.nodes[0].place(Time::from_seconds(99)), Vec3(83.5, 139, 0));
  EXPECT_FALSE(network.nodes[1].moves());
}

TEST(NetworkTables, Ns2NodesJumpWhereTheirPlaceIsSetLater) {
  NetworkCase network;
  const auto read = read_ns2_movement(
      "$ns_ at 0 \"$node_(1) set X_ 10\"\n"
      "$ns_ at 5 \"$node_(1) set X_ 100\"\n"
      "$ns_ at 5 \"$node_(1) set Y_ 200\"\n"
      "$ns_ at 10 \"$node_(1) setdest 100 300 10\"\n"
      "$ns_ at 12 \"$node_(1) set Z_ 50\"\n"
      "$ns_ at 15 \"$node_(1) set X_ 0\"\n"
      "$ns_ at 20 \"$node_(1) setdest 0 0 10\"\n"
      "$ns_ at 20 \"$node_(1) set Y_ 7\"\n",
      "m.ns2", network);
  ASSERT_TRUE(read.ok()) << read.error().text();
  const auto at = [&](double time) -> Vec3 {
    return network.nodes[0].place(Time::from_seconds(time));
  };
  EXPECT_EQ(at(0), Vec3(10, 0, 0));
  EXPECT_EQ(at(4.999), Vec3(10, 0, 0));
  EXPECT_EQ(at(5), Vec3(100, 200, 0));
  EXPECT_EQ(at(12), Vec3(100, 220, -50)) << "the movement goes on at another height";
  EXPECT_NEAR((at(14.5) - Vec3(100, 245, -50)).norm(), 0, 1e-6);  // 1 ns of 10 m/s
  EXPECT_EQ(at(15), Vec3(0, 250, -50)) << "and ends where X_ is set";
  EXPECT_EQ(at(19.999), Vec3(0, 250, -50));
  EXPECT_EQ(at(99), Vec3(0, 7, -50)) << "also in the moment in which it begins";
  for (std::size_t k = 1; k < network.nodes[0].points.size(); ++k)
    EXPECT_LT(network.nodes[0].points[k - 1].time, network.nodes[0].points[k].time);
  EXPECT_FALSE(read_ns2_movement("$ns_ at 5 \"$node_(1) set X_ 1\"\n"
                                 "$ns_ at 4 \"$node_(1) set X_ 2\"\n",
                                 "m.ns2", network)
                   .ok());
}

}  // namespace
}  // namespace skein::exchange::network_tables_test
