// SPDX-License-Identifier: Apache-2.0
// skein net: the radio medium alone, against the traces and figures of a packet-level
// simulator, and what it refuses.
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

const fs::path kReference = SKEIN_SHARED_DATA "/net";

std::string unpacked(const fs::path& file) {
  std::string text;
  const std::string command = "gunzip -c '" + file.string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 65536> block{};
  while (const std::size_t got = fread(block.data(), 1, block.size(), pipe))
    text.append(block.data(), got);
  pclose(pipe);
  return text;
}

struct FrameStart {
  double us;
  std::string what;  // kind and bytes
};

// The frames of each node, in order.
std::map<std::string, std::vector<FrameStart>> frames_of(const std::string& trace) {
  std::map<std::string, std::vector<FrameStart>> found;
  std::istringstream lines(trace);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t a = line.find(','), b = line.find(',', a + 1);
    found[line.substr(a + 1, b - a - 1)].push_back({std::stod(line), line.substr(b + 1)});
  }
  return found;
}

// Frames that begin before the first one that differs, in kind, bytes or by more than
// 1 us.
std::pair<std::size_t, std::size_t> same_frames(const std::string& ours,
                                                const std::string& theirs) {
  auto a = frames_of(ours), b = frames_of(theirs);
  double differs = 1e300;
  for (auto& [node, frames] : b)
    for (std::size_t i = 0; i < frames.size(); ++i)
      if (i >= a[node].size() || std::abs(a[node][i].us - frames[i].us) > 1 ||
          a[node][i].what != frames[i].what) {
        differs = std::min(differs, frames[i].us);
        if (i < a[node].size()) differs = std::min(differs, a[node][i].us);
        break;
      }
  std::size_t same = 0, all = 0;
  for (const auto& [node, frames] : b)
    for (const FrameStart& frame : frames) {
      ++all;
      if (frame.us < differs) ++same;
    }
  return {same, all};
}

TEST_F(Program, NetSendsTheFramesOfTheReference) {
  if (!fs::exists(kReference)) GTEST_SKIP() << "the reference is not part of the project";
  int good = 0, cases = 0;
  for (const auto& each : fs::directory_iterator(kReference / "det/traces")) {
    // det_<profile>_n<nodes>_rate<rate>_T10_k<K>_rts<0|1>.csv.gz
    const std::string name = each.path().filename().string();
    std::istringstream parts(name.substr(0, name.find('.')));
    std::vector<std::string> words;
    for (std::string word; std::getline(parts, word, '_');) words.push_back(word);
    ASSERT_EQ(words.size(), 7u) << name;
    const std::string grid = words[2] + "_" + words[3] + "_" + words[4] + ".csv";
    const std::string profile =
        words[1] + (words[6] == "rts1" ? "_rts_" : "_") + words[5];
    const Finished done =
        run({"net", "--nodes", (kReference / "det" / ("nodes_" + grid)).string(),
             "--traffic", (kReference / "det" / ("traffic_" + grid)).string(),
             "--profile", (kReference / "profiles" / (profile + ".yaml")).string(),
             "--duration", "10", "--trace", "t.csv", "--out", "m.csv"});
    ASSERT_EQ(done.status, 0) << done.err;
    const auto [same, all] =
        same_frames(read_file(folder_ / "t.csv"), unpacked(each.path()));
    ++cases;
    if (same == all || same >= 1000) ++good;
    EXPECT_EQ(same, all) << name;
    EXPECT_EQ(read_file(folder_ / "m.csv"), unpacked(kReference / "det/messages" / name))
        << name;
  }
  EXPECT_GE(cases, 20);
  EXPECT_EQ(good, cases);
}

// The messages without their times of delivery, and these.
std::pair<std::string, std::vector<double>> apart(const std::string& messages) {
  std::pair<std::string, std::vector<double>> found;
  std::istringstream lines(messages);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::size_t begin = 0;
    for (int comma = 0; comma < 4; ++comma) begin = line.find(',', begin) + 1;
    const std::size_t end = line.find(',', begin);
    found.first += line.substr(0, begin) + line.substr(end) + "\n";
    found.second.push_back(end > begin ? std::stod(line.substr(begin)) : -1);
  }
  return found;
}

TEST_F(Program, NetMovesNodesAndCountsBroadcastsLikeTheReference) {
  if (!fs::exists(kReference)) GTEST_SKIP() << "the reference is not part of the project";
  for (const std::string profile : {"cs91_k7", "cs91_rts_k7", "nn4_k7", "nn4_rts_k7"}) {
    const Finished done =
        run({"net", "--nodes", (kReference / "example/nodes.csv").string(), "--traffic",
             (kReference / "example/traffic.csv").string(), "--profile",
             (kReference / "profiles" / (profile + ".yaml")).string(), "--duration", "10",
             "--trace", "t.csv", "--out", "m.csv"});
    ASSERT_EQ(done.status, 0) << done.err;
    const auto [same, all] =
        same_frames(read_file(folder_ / "t.csv"),
                    unpacked(kReference / "example" / ("trace_" + profile + ".csv.gz")));
    EXPECT_EQ(same, all) << profile;
    const auto ours = apart(read_file(folder_ / "m.csv"));
    const auto theirs =
        apart(unpacked(kReference / "example" / ("messages_" + profile + ".csv.gz")));
    EXPECT_EQ(ours.first, theirs.first) << profile;
    ASSERT_EQ(ours.second.size(), theirs.second.size());
    // Places of nodes that move are 10 ms old at most: 0.5 m of way.
    for (std::size_t i = 0; i < ours.second.size(); ++i)
      EXPECT_NEAR(ours.second[i], theirs.second[i], 2e-9) << profile << " row " << i;
  }
}

constexpr const char* kThreeNodes =
    "node,time_s,x_m,y_m,z_m\n"
    "3,0,0,0,0\n"
    "5,0,100,0,0\n"
    "9,0,5000,0,0\n";

TEST_F(Program, NetSaysWhatBecameOfEachMessage) {
  write("n.csv", kThreeNodes);
  write("t.csv",
        "message,time_s,from,to,bytes\n"
        "0,0.1,3,5,1000\n"
        "1,0.2,5,9,100\n"
        "2,0.3,5,*,50\n"
        "3,0.999999,3,5,1000\n"
        "4,1.5,3,5,1000\n");
  const Finished done =
      run({"net", "--nodes", "n.csv", "--traffic", "t.csv", "--profile", "nn4",
           "--duration", "1", "--out", "m.csv", "--report", "page.html"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(read_file(folder_ / "m.csv"),
            "message,from,to,sent_s,delivered_s,outcome,transmissions,rts\n"
            "0,3,5,0.100000000,0.104386334,delivered,1,0\n"
            "1,5,9,0.200000000,,retry-limit,7,0\n"
            "2,5,3,0.300000000,0.300586334,delivered,1,0\n"
            "2,5,9,0.300000000,,out-of-range,1,0\n"
            "3,3,5,0.999999000,,pending,0,0\n");
  EXPECT_NE(done.out.find("3 sent, 1 delivered"), std::string::npos) << done.out;
  EXPECT_NE(read_file(folder_ / "page.html").find("Who hears whom"), std::string::npos);
}

TEST_F(Program, NetRefusesWhatItCouldNotWriteOrIsNoSeed) {
  write("n.csv", "node,time_s,x_m,y_m,z_m\n3,0,0,0,0\n5,0,100,0,0\n");
  write("t.csv", "message,time_s,from,to,bytes\n0,0.1,3,5,1000\n");
  const auto net = [this](const std::string& out, const std::string& seed) {
    // A simulation of this length would take minutes.
    return run({"net", "--nodes", "n.csv", "--saturate", "3,5,1,5", "--profile", "nn4",
                "--duration", "1000000", "--out", out, "--seed", seed});
  };
  for (const char* out : {"no-such-folder/m.csv", "."}) {
    const Finished done = net(out, "1");
    EXPECT_NE(done.status, 0);
    EXPECT_NE(done.err.find("cannot be written"), std::string::npos) << done.err;
  }
  for (const char* seed : {"-4", "1.5", "x", "18446744073709551616"}) {
    const Finished done = net("m.csv", seed);
    EXPECT_EQ(done.status, 2) << seed;
    EXPECT_NE(done.err.find("whole number from 0 on"), std::string::npos) << done.err;
  }
  EXPECT_EQ(
      run({"relay", "--listen", "udpin:0", "--to", "127.0.0.1:9", "--seed", "-4"}).status,
      2);
}

TEST_F(Program, RadiosAreListedAndTheirKeysDocumented) {
  const Finished list = run({"list", "radio-profile"});
  EXPECT_EQ(list.status, 0) << list.err;
  for (const char* name : {"nn4", "cs91", "wifi-dsss-2", "xbee-digimesh"})
    EXPECT_NE(list.out.find(std::string("  ") + name + " "), std::string::npos)
        << list.out;
  const std::pair<const char*, const char*> parts[] = {{"propagation", "two-ray"},
                                                       {"antenna", "dipole"},
                                                       {"error-model", "cck-11"},
                                                       {"access", "tdma"}};
  for (const auto& [role, kind] : parts) {
    const Finished kinds = run({"list", role});
    EXPECT_EQ(kinds.status, 0) << kinds.err;
    EXPECT_NE(kinds.out.find(std::string("  ") + kind), std::string::npos) << kinds.out;
  }
  EXPECT_EQ(run({"keys", "radio"}).out, read_file(SKEIN_SOURCE_DIR "/docs/radio-keys.md"))
      << "Renew it: build/release/skein keys radio > docs/radio-keys.md";
}

TEST_F(Program, NetReadsNs2MovementWhateverItsFileIsCalled) {
  write("n.txt",
        "# two nodes\n"
        "$node_(0) set X_ 0.0\n"
        "$node_(0) set Y_ 0.0\n"
        "$node_(1) set X_ 1000.0\n"
        "$ns_ at 1.0 \"$node_(1) setdest 50.0 0.0 100.0\"\n");
  write("t.csv", "message,time_s,from,to,bytes\n0,0.5,0,*,10\n1,9,0,*,10\n2,12,0,*,10\n");
  const Finished done = run({"net", "--nodes", "n.txt", "--traffic", "t.csv", "--profile",
                             "nn4", "--duration", "20", "--out", "m.csv"});
  EXPECT_EQ(done.status, 0) << done.err;
  // 119 m are reached at 9.8 s.
  const std::string messages = read_file(folder_ / "m.csv");
  EXPECT_NE(messages.find("\n1,0,1,9.000000000,,out-of-range"), std::string::npos)
      << messages;
  EXPECT_NE(messages.find("\n2,0,1,12.000000000,12.0"), std::string::npos) << messages;
}

TEST_F(Program, NetWritesOverNoFileOfItsOwn) {
  write("n.csv", kThreeNodes);
  fs::create_symlink("n.csv", folder_ / "same.csv");
  const auto net = [&](const char* out, const char* trace) {
    return run({"net", "--nodes", "n.csv", "--saturate", "3,5,1000,1", "--profile", "nn4",
                "--duration", "1", "--out", out, "--trace", trace});
  };
  for (const auto& [out, trace] :
       {std::pair("n.csv", "f.csv"), std::pair("m.csv", "./n.csv"),
        std::pair("same.csv", "f.csv"), std::pair("m.csv", "./m.csv")}) {
    const Finished refused = net(out, trace);
    EXPECT_EQ(refused.status, 2) << out << " " << trace;
    EXPECT_NE(refused.err.find("under another option"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "n.csv"), kThreeNodes);
  }
  EXPECT_EQ(net("m.csv", "f.csv").status, 0);
}

TEST_F(Program, NetSaysWhatIsWrong) {
  write("n.csv", kThreeNodes);
  write("t.csv", "message,time_s,from,to,bytes\n0,0.1,3,5,1000\n");
  const auto net = [&](const std::string& nodes, const std::string& traffic,
                       const std::string& profile = "nn4",
                       const std::string& duration = "1") {
    return run({"net", "--nodes", nodes, "--traffic", traffic, "--profile", profile,
                "--duration", duration, "--out", "m.csv"});
  };
  const auto expect = [](const Finished& finished, const std::string& part) {
    EXPECT_EQ(finished.status, 2) << finished.out;
    EXPECT_NE(finished.err.find(part), std::string::npos) << finished.err;
  };
  expect(net("none.csv", "t.csv"), "none.csv");
  expect(net("n.csv", "t.csv", "nn5"), "there is no radio \"nn5\"");
  expect(net("n.csv", "t.csv", "nn4", "-3"), "--duration");
  write("r.yaml", "phy: {transmit_power_dbm: 900, noise_bandwidth_hz: -1}\n");
  const Finished two = net("n.csv", "t.csv", "r.yaml");
  expect(two, "phy.transmit_power_dbm");
  expect(two, "phy.noise_bandwidth_hz");
  write("bad.csv", "message,time_s,from,to,bytes\n0,0.1,3,4,1000\n");
  expect(net("n.csv", "bad.csv"), "bad.csv:2: column \"to\": there is no node 4.");
  write("bad.csv", "message,time_s,from,to,bytes\n0,0.1,3,3,1000\n");
  expect(net("n.csv", "bad.csv"), "bad.csv:2: column \"to\": node 3 sends to itself.");
  write("bad.csv", "message,time_s,from,to,bytes\n0,0.1,3,5,10000000\n");
  expect(net("n.csv", "bad.csv"),
         "\"bytes\": \"10000000\" is no whole number from 0 to 65000.");
  write("bad.csv", "message,time_s,from,to\n0,0.1,3,5\n");
  expect(net("n.csv", "bad.csv"), "column \"bytes\" is missing.");
  expect(run({"net", "--nodes", "n.csv", "--saturate", "3,5,1000", "--profile", "nn4",
              "--duration", "1", "--out", "m.csv"}),
         "It is FROM,TO,BYTES,DEPTH");
  expect(run({"net", "--nodes", "n.csv", "--profile", "nn4", "--duration", "1", "--out",
              "m.csv"}),
         "nothing is sent.");
  EXPECT_FALSE(fs::exists(folder_ / "m.csv"));
}

}  // namespace
}  // namespace skein::app
