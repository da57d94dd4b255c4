// SPDX-License-Identifier: Apache-2.0
// skein team messages
#include "app/test/program.h"

namespace skein::app {
namespace {

using TeamMessages = Program;

TEST_F(TeamMessages, SaysWhatIsSentOfWhichKindInWhichPhase) {
  const Finished flown =
      run({"run", SKEIN_SOURCE_DIR "/scenarios/message-load.yaml", "--set",
           "duration_s=60", "--set", "aircraft[0].count=2", "--out", "r"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const Finished done = run({"team", "messages", "r", "--at", "0=registration",
                             "30=waiting", "--header", "0", "--out", "load.csv"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("mean of 2"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("registration"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("team_inform"), std::string::npos) << done.out;
  const std::string csv = read_file(folder_ / "load.csv");
  EXPECT_EQ(csv.find("phase,from_s,until_s,entity,kind,messages,bytes,bytes_per_s\n"),
            0u);
  // A place each second, to all: counted once, not for each receiver.
  EXPECT_NE(csv.find("\nwaiting,30,60,scout-1,place_report,30,"), std::string::npos)
      << csv;
}

TEST_F(TeamMessages, RefusesWhatIsNoRunAndTimesThatAreNone) {
  EXPECT_EQ(run({"team", "messages"}).status, 2);
  const Finished none = run({"team", "messages", "nowhere"});
  EXPECT_NE(none.status, 0);
  EXPECT_NE(none.err.find("nowhere"), std::string::npos) << none.err;
  const Finished word = run({"team", "messages", "nowhere", "--at", "soon"});
  EXPECT_EQ(word.status, 2);
  EXPECT_NE(word.err.find("\"soon\" is no time in seconds"), std::string::npos)
      << word.err;
  EXPECT_EQ(run({"team", "messages", "nowhere", "--header", "-1"}).status, 2);
}

}  // namespace
}  // namespace skein::app
