// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/serve/serve_options.h"

namespace skein::app {

/// Exit status of the program: see docs/user-guide.md.
enum Exit { kDone = 0, kFailed = 1, kBadUsage = 2, kInterrupted = 130 };

struct RunArguments {
  std::string scenario;
  std::filesystem::path out;           ///< empty = runs/NAME, runs/NAME-2...
  std::vector<std::string> overrides;  ///< a.b[2].c=VALUE
  std::vector<std::string> plugins;    ///< besides those of the scenario
  std::vector<std::string> trusted;    ///< folders, see trust.h
  std::string seed;                    ///< empty = the scenario's
  std::string speed;  ///< fast, real, or a factor; empty = fast, or real if it must be
  int threads = 1;
  bool report = false;
  bool json = false;
  bool overwrite = false;
  bool commands = false;         ///< read the operator's from standard input
  std::filesystem::path replay;  ///< a run that is done again; empty = none
  std::optional<std::string>
      serve;                 ///< ADDRESS:PORT of the operator's page; none: no page
  serve::ServeOptions page;  ///< the rest of how it is served
};

struct FlyArguments {
  std::string aircraft;      ///< name of a built-in one, or a file
  std::string input;         ///< CSV; - = standard input
  std::string output = "-";  ///< CSV; - = standard output
  double step = 0.005;       ///< longest integration step [s]
  /// Gravity falls off with height as on a sphere of this radius [m]; 0 = flat. The
  /// default is that of the comparison in docs/fly.md, flat to 2e-6 below 600 m.
  double planet_radius = 637.1e6;
};

struct TrimArguments {
  std::string aircraft;
  std::optional<double> airspeed;  ///< [m/s]; none: all over its range
  double climb_deg = 0;            ///< of the path through the air
  double turn_radius = 0;          ///< to the right [m]; 0: bank_deg counts
  double bank_deg = 0;             ///< to the right
  double altitude = 0;             ///< above mean sea level [m]
  bool json = false;
  double hold = 0;  ///< print an input table that holds the trim so long [s]; 0: do not
};

/// `skein vehicle`.
struct VehicleArguments {
  std::string aircraft = "bixler";  ///< built in, a file, or "point"
  std::string name = "vehicle";
  std::vector<std::string> links = {"udpout:127.0.0.1:14550"};
  std::string autopilot = "ardupilot";   ///< or px4: what it looks like
  std::string key_file;                  ///< of its links; empty: they are not signed
  std::string unsigned_frames = "auto";  ///< may do: auto, all or telemetry
  int system = 1;
  double latitude_deg = 36.989, longitude_deg = -122.0514;
  double north = 0, east = 0;  ///< where it begins, from there [m]
  double ground_msl = 0;       ///< [m]
  double heading_deg = 0;
  double altitude = 100;    ///< above the ground, where it begins in flight [m]
  bool flying = false;      ///< it begins in flight; a point always does
  bool true_state = false;  ///< its autopilot knows its true state
  double wind_speed = 0, wind_from_deg = 0;
  double step = 0.02;   ///< [s]
  double duration = 0;  ///< [s]; 0: until it is interrupted
  std::uint64_t seed = 1;
  std::filesystem::path out;  ///< folder for records; empty: none
  bool overwrite = false;
};

/// `skein agent`.
struct AgentArguments {
  std::string scenario;
  std::string entity;             ///< an aircraft of the scenario
  std::string world;              ///< where its world is met; empty: it is alone
  std::vector<std::string> team;  ///< where other agents are met directly
  std::string autopilot;  ///< MAVLink endpoint; empty: the vehicle is simulated here
  int system = 1;         ///< MAVLink system id there
  std::string modem;      ///< where its modem is; empty: its messages go by the world
  std::uint32_t hw = 0;   ///< address of its modem; 0: by its number
  double modem_rate = 0;  ///< that its modem can carry [bit/s]; 0: see AgentModem
  std::string key_file;   ///< of its team, for the modem; empty: that of the scenario
  double duration = 0;    ///< [s]; 0: until it is interrupted
  std::vector<std::string> overrides, plugins, trusted;
  std::filesystem::path out;  ///< folder for records; empty: none
  bool overwrite = false;
};

struct CheckArguments {
  std::vector<std::string> files;  ///< scenarios, aircraft, radios, relays, campaigns
  std::vector<std::string> overrides, plugins, trusted;
  bool filled_in = false;  ///< print scenarios with all defaults
  bool update = false;     ///< rewrite names of former versions first
};

int agent_command(const AgentArguments& arguments, const std::atomic<bool>& stop);
int vehicle_command(const VehicleArguments& arguments, const std::atomic<bool>& stop);
int run_command(const RunArguments& arguments, const std::atomic<bool>& stop);
int check_command(const CheckArguments& arguments);
int list_command(const std::string& role, const std::vector<std::string>& plugins);
/// Puts the kinds of plugins, or without one all kinds, to the test of their contracts.
int verify_command(const std::string& role, const std::vector<std::string>& plugins);
int schema_command(const std::string& document, const std::vector<std::string>& plugins);
int keys_command(const std::string& document, const std::vector<std::string>& plugins);
int fly_command(const FlyArguments& arguments, const std::atomic<bool>& stop);
int trim_command(const TrimArguments& arguments);
/// `skein export`.
struct ExportArguments {
  std::filesystem::path run;  ///< its folder
  std::string what;           ///< perimeter, bands, prediction, tracks or zones
  std::optional<double> at;   ///< simulated time [s]; none: the last
  std::filesystem::path out;  ///< .geojson, .kml, .gpkg or .shp
  double every = 0;           ///< renewed so often until the run ends [s]; 0: once
};
int export_command(const ExportArguments& arguments, const std::atomic<bool>& stop);
/// `skein fire`.
struct FireArguments {
  std::filesystem::path source;  ///< file or folder
  std::string time_field;        ///< empty: it is looked for
  std::string incident;          ///< of those that the source holds
  double utc_offset_h = 0;       ///< of times without a zone
  std::string date_order;  ///< "month-first", "day-first", "year-first"; empty: as shown
  std::filesystem::path scenario, out;  ///< files to be written; empty: none
};
int fire_command(const FireArguments& arguments);
/// `skein link`.
struct LinkArguments {
  std::vector<std::string> endpoints;  ///< as transport::parse_endpoint() reads them
  std::filesystem::path tlog;          ///< record of all frames; empty: none
  bool unsigned_orders = true;         ///< from beyond this machine are handed on
  bool overwrite = false;
  double every = 10;    ///< between tables [s]
  double duration = 0;  ///< [s]; 0: until it is interrupted
};
int link_command(const LinkArguments& arguments, const std::atomic<bool>& stop);
int report_command(const std::vector<std::filesystem::path>& runs,
                   const std::filesystem::path& out);
/// `skein campaign`.
struct CampaignArguments {
  std::filesystem::path file;
  std::filesystem::path out;             ///< empty = runs/campaign-NAME
  std::optional<int> seeds, first_seed;  ///< none: the file's
  int threads = 2;
  std::vector<std::string> only;  ///< names of variants; of an axis without any: all
  std::vector<std::string> overrides;
  std::vector<std::string> plugins, trusted;
  bool scenarios = false;  ///< write those of all runs
};
int campaign_command(const CampaignArguments& arguments, const std::atomic<bool>& stop);
int completion_command(const std::string& shell);

}  // namespace skein::app
