// SPDX-License-Identifier: Apache-2.0
// A folder where a file belongs is refused by name, whatever reads it.
#include "app/test/program.h"

namespace skein::app {
namespace {

TEST_F(Program, RefusesAFolderWhereAFileBelongs) {
  for (const char* name : {"folder", "folder.json", "folder.csv", "folder.plan",
                           "folder.geojson", "folder.yaml"})
    fs::create_directory(folder_ / name);
  write("e.csv", "case,aircraft,alerter,north_m,east_m,down_m,vn_mps,ve_mps,vd_mps\n");
  const std::vector<std::vector<std::string>> commands = {
      {"avoid", "detect", "--batch", "folder", "--config", "skein_suas", "--out", "a"},
      {"avoid", "detect", "--batch", "e.csv", "--config", "folder.json", "--out", "a"},
      {"avoid", "negotiate", "--batch", "folder", "--out", "a"},
      {"team", "allocate", "--batch", "folder", "--out", "a"},
      {"team", "route", "--batch", "folder", "--out", "a"},
      {"team", "tours", "--batch", "folder", "--out", "a"},
      {"team", "rehearse", "--scripts", "folder", "--out", "a"},
      {"net", "--nodes", "folder", "--profile", "wifi-dsss-2", "--duration", "5", "--out",
       "a"},
      {"plan", "connect", "--batch", "folder"},
      {"plan", "coverage", "--area", "folder.plan", "--origin", "47,8", "--swath-m",
       "100", "--airspeed", "15", "--turn-radius", "40", "--from", "0,0,0"},
      {"plan", "coverage", "--area", "folder.geojson", "--origin", "47,8", "--swath-m",
       "100", "--airspeed", "15", "--turn-radius", "40", "--from", "0,0,0"},
      {"study", "estimators", "--cases", "folder"},
      {"study", "estimators", "--updates", "folder"},
      {"study", "avoidance", "--cases", "folder", "--out", "a"},
      {"fly", "--aircraft", "aerosonde", "--input", "folder", "--output", "a"},
      {"run", "folder.yaml"},
      {"check", "folder.yaml"},
      {"campaign", "folder.yaml"}};
  for (const std::vector<std::string>& command : commands) {
    const Finished refused = run(command);
    const std::string named = command[0] + ' ' + command[1];
    EXPECT_EQ(refused.status, 2) << named << ": " << refused.err;
    EXPECT_NE(refused.err.find("folder"), std::string::npos) << named << refused.err;
    EXPECT_EQ(refused.err.find("header"), std::string::npos)
        << "read as if it were empty";
    EXPECT_EQ(refused.err.find("internal error"), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(folder_ / "a")) << named;
  }
}

}  // namespace
}  // namespace skein::app
