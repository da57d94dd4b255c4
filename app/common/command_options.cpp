// SPDX-License-Identifier: Apache-2.0
#include "app/common/command_options.h"

#include <map>

#include "skein/base/log.h"

namespace skein::app {

void add_log_option(CLI::App& command) {
  static const std::map<std::string, LogLevel> kLevels = {{"debug", LogLevel::kDebug},
                                                          {"info", LogLevel::kInfo},
                                                          {"warning", LogLevel::kWarning},
                                                          {"error", LogLevel::kError}};
  command
      .add_option_function<std::string>(
          "--log", [](const std::string& level) { set_log_level(kLevels.at(level)); },
          "Say on standard error what happens: debug, info (events), warning, error.")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
      ->type_name("LEVEL");
}

void add_serve_options(CLI::App& command, std::optional<std::string>& serve,
                       serve::ServeOptions& page) {
  auto* wanted =
      command
          .add_option_function<std::vector<std::string>>(
              "--serve",
              [&serve](const std::vector<std::string>& at) {
                serve = at.empty() ? std::string() : at.front();
              },
              "Show the operator's page, in real time: at 127.0.0.1:8080, a port or "
              "ADDRESS:PORT (docs/page.md).")
          ->expected(0, 1)
          ->type_name("PLACE");
  command
      .add_option("--tokens", page.tokens_file,
                  "File of lines TOKEN ROLE [NAME]: who may see and steer; needed where "
                  "other machines reach the page.")
      ->needs(wanted);
  auto* certificate =
      command
          .add_option("--certificate", page.certificate_file,
                      "PEM file of the page's certificate: it is served over TLS.")
          ->needs(wanted);
  command
      .add_option("--key", page.key_file,
                  "PEM file of its key; default: the certificate's file.")
      ->needs(certificate);
  command
      .add_option("--host", page.hosts,
                  "A name by which browsers reach this machine, such as "
                  "ground.example.org, besides its own and those of the certificate; "
                  "may be repeated.")
      ->type_name("NAME")
      ->needs(wanted);
  command
      .add_option("--viewer-origin", page.viewer_origins,
                  "A page of another server that may watch by Foxglove's protocol, by "
                  "its origin, such as https://app.foxglove.dev; may be repeated.")
      ->type_name("ORIGIN")
      ->needs(wanted);
  command
      .add_option("--imagery", page.imagery,
                  "Address of pictures of the ground, with {z}, {x} and {y}, for the "
                  "page's map.")
      ->needs(wanted);
}

void add_plugin_option(CLI::App& command, std::vector<std::string>& plugins) {
  command
      .add_option("--plugin", plugins,
                  "A shared library with kinds of your own; may be repeated.")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
}

void add_trust_option(CLI::App& command, std::vector<std::string>& folders) {
  command
      .add_option("--trust", folders,
                  "Libraries and programs that scenarios in this folder name may run "
                  "(docs/extending.md); may be repeated.")
      ->type_name("FOLDER")
      ->take_all()
      ->allow_extra_args(false);
}

void add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "KEY=VALUE: overrides a key of the scenario.")
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace skein::app
