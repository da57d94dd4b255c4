// SPDX-License-Identifier: Apache-2.0
// The options of commands that talk to others by links.
#include <memory>

#include "app/common/command_options.h"
#include "app/common/commands.h"
#include "app/common/number_range.h"

namespace skein::app {
namespace {

constexpr const char* kVehicleExamples = R"(
It behaves as a vehicle with ArduPilot or PX4 towards QGroundControl, Mission Planner,
MAVProxy, MAVSDK and Skein itself, for tests, demonstrations and training. It stands on the
ground until it is armed and told to take off.

Examples:
  skein vehicle                                  # a foam glider, at udpout:127.0.0.1:14550
  skein vehicle --aircraft quad --link tcpin:5760 --autopilot px4
  skein vehicle --aircraft aerosonde --flying --system 7 --link udpout:127.0.0.1:14551)";

constexpr const char* kAgentExamples = R"(
It reads the scenario of its world and is one aircraft of it, whose vehicle the world has as
{kind: remote}; see docs/agent.md. When the world is gone it goes on alone.

Examples:
  skein run fire.yaml --set "aircraft[0].vehicle={kind: remote, listen: 'udpin:14700'}"
  skein agent fire.yaml --entity scout-1 --world udpout:127.0.0.1:14700
  skein agent fire.yaml --entity scout-1 --world udpout:10.0.0.2:14700 \
      --autopilot serial:/dev/ttyACM0:115200 --team udpmulti:239.255.77.1:14800:10.0.0.7
  skein agent fire.yaml --entity scout-1 --world udpout:10.0.0.2:14700 \
      --modem serial:/dev/ttyUSB0:57600)";

constexpr const char* kLinkExamples = R"(
Endpoints:
  udpin:[HOST:]PORT      waits for datagrams, answers each sender
  udpout:HOST:PORT       sends to one place
  udpbcast:ADDRESS:PORT  sends to all of a network
  udpmulti:GROUP:PORT[:INTERFACE]  sends to all of a multicast group, and hears them
  tcpin:[HOST:]PORT      waits for connections
  tcp:HOST:PORT          connects, again and again
  serial:DEVICE[:BAUD]   a serial line; 57600 without a rate
Without a host, only programs of this machine are let in.

Examples:
  skein link serial:/dev/ttyACM0:115200 udpout:127.0.0.1:14550 --tlog flight.tlog
  skein link tcp:127.0.0.1:5760 udpin:14551 tcpin:0.0.0.0:5790)";

}  // namespace

Command add_link(CLI::App& program, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<LinkArguments>();
  auto* command = program.add_subcommand(
      "link", "Hand MAVLink on between sockets and serial lines, and record it.");
  command->add_option("endpoint", given->endpoints, "Two or more, or one to record.")
      ->required();
  command->add_option("--tlog", given->tlog, "Record all frames that come in (.tlog).");
  command->add_flag("--overwrite", given->overwrite, "Replace a record that is there.");
  command->add_option("--every", given->every, "Seconds between tables of how links do.")
      ->check(CLI::Range(0.1, 86400.0));
  command->add_option("--for", given->duration, "End after so many seconds.")
      ->check(CLI::Range(0.1, 1e9));
  command
      ->add_option_function<std::string>(
          "--unsigned",
          [given](const std::string& what) { given->unsigned_orders = what == "all"; },
          "Frames without a signature from beyond this machine: all are handed on (the "
          "default), or telemetry, without commands, parameters and missions.")
      ->check(CLI::IsMember({"all", "telemetry"}));
  command->footer(kLinkExamples);
  return {command, [given, &stop] { return link_command(*given, stop); }};
}

Command add_vehicle(CLI::App& program, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<VehicleArguments>();
  auto* command = program.add_subcommand(
      "vehicle", "One simulated aircraft as a MAVLink vehicle of its own.");
  command
      ->add_option("--aircraft", given->aircraft,
                   "Built in, a file, or \"point\": a point in coordinated flight.")
      ->capture_default_str();
  command->add_option("--name", given->name, "What it is called.")->capture_default_str();
  command
      ->add_option("--link", given->links,
                   "Where ground stations or Skein are met; several times for several.")
      ->capture_default_str();
  command->add_option("--autopilot", given->autopilot, "What it looks like.")
      ->capture_default_str()
      ->check(CLI::IsMember({"ardupilot", "px4"}));
  command->add_option("--system", given->system, "Its MAVLink system id.")
      ->capture_default_str()
      ->check(CLI::Range(1, 250));
  command->add_option("--key", given->key_file,
                      "File with the key of its links, which are then signed.");
  command
      ->add_option("--unsigned", given->unsigned_frames,
                   "What frames without a signature may do: all, telemetry (report and "
                   "ask), or auto: nothing with --key, else all from this machine and "
                   "telemetry from beyond it.")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "all", "telemetry"}));
  command->add_option("--latitude", given->latitude_deg, "Of the local origin.")
      ->capture_default_str();
  command->add_option("--longitude", given->longitude_deg, "Of the local origin.")
      ->capture_default_str();
  command->add_option("--north", given->north, "Where it begins [m].")
      ->capture_default_str();
  command->add_option("--east", given->east, "Where it begins [m].")
      ->capture_default_str();
  command->add_option("--ground", given->ground_msl, "Ground above sea level [m].")
      ->capture_default_str();
  command->add_option("--heading", given->heading_deg, "At the start [deg].")
      ->capture_default_str();
  command->add_flag("--flying", given->flying, "It begins in flight.");
  command
      ->add_option("--altitude", given->altitude,
                   "Above the ground, where it begins in flight [m].")
      ->capture_default_str();
  command->add_flag("--true-state", given->true_state,
                    "Its autopilot knows its true state, without sensors.");
  command->add_option("--wind", given->wind_speed, "Of its own air [m/s].")
      ->capture_default_str();
  command->add_option("--wind-from", given->wind_from_deg, "[deg]")
      ->capture_default_str();
  command->add_option("--step", given->step, "Of its simulation [s].")
      ->capture_default_str()
      ->check(CLI::Range(0.005, 0.1));
  command->add_option("--seed", given->seed, "Of its sensors' errors.")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--for", given->duration, "End after so many seconds.")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--out", given->out, "Folder for records; default: none.");
  command->add_flag("--overwrite", given->overwrite, "Replace records that are there.");
  command->footer(kVehicleExamples);
  return {command, [given, &stop] { return vehicle_command(*given, stop); }};
}

Command add_agent(CLI::App& program, const std::atomic<bool>& stop) {
  const auto given = std::make_shared<AgentArguments>();
  auto* command =
      program.add_subcommand("agent", "One aircraft's agent in a program of its own.");
  command->add_option("scenario", given->scenario, "The scenario file of its world.")
      ->required();
  command->add_option("--entity", given->entity, "Which aircraft: GROUP-1, GROUP-2...")
      ->required();
  command->add_option("--world", given->world,
                      "Where its world is met: udpout:HOST:PORT or tcp:HOST:PORT.");
  command
      ->add_option("--team", given->team,
                   "Where other agents are met directly; several times for several.")
      ->take_all()
      ->allow_extra_args(false);
  auto* modem = command->add_option(
      "--modem", given->modem,
      "Where its radio modem is: serial:DEVICE:BAUD, udpout:HOST:PORT...; its messages "
      "go over it, not by its world.");
  command
      ->add_option("--hw", given->hw,
                   "Address of the modem; default: the aircraft's number and 1.")
      ->check(CLI::Range(1.0, 4294967294.0))
      ->needs(modem);
  command
      ->add_option("--modem-rate", given->modem_rate,
                   "What the modem can carry [bit/s]; default: what a serial line does "
                   "(8 of 10 bits), and of others no limit: then its load is not known.")
      ->check(CLI::Range(100.0, 1e9))
      ->needs(modem);
  command
      ->add_option("--key", given->key_file,
                   "File with the team's key, by which what goes over the modem is known "
                   "to be authentic; default: that of the scenario's radio.")
      ->needs(modem);
  auto* autopilot =
      command->add_option("--autopilot", given->autopilot,
                          "Where its autopilot is met by MAVLink; else the vehicle is "
                          "simulated here.");
  command->add_option("--system", given->system, "MAVLink system id of the autopilot.")
      ->capture_default_str()
      ->check(CLI::Range(1, 255))
      ->needs(autopilot);
  add_set_option(*command, given->overrides);
  add_plugin_option(*command, given->plugins);
  add_trust_option(*command, given->trusted);
  command->add_option("--for", given->duration, "End after so many seconds.")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--out", given->out, "Folder for records; default: none.");
  command->add_flag("--overwrite", given->overwrite, "Replace records that are there.");
  add_log_option(*command);
  command->footer(kAgentExamples);
  return {command, [given, &stop] { return agent_command(*given, stop); }};
}

}  // namespace skein::app
