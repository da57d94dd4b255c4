#include "app/command_options.h"

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

void add_plugin_option(CLI::App& command, std::vector<std::string>& plugins) {
  command
      .add_option("--plugin", plugins,
                  "A shared library with kinds of your own; may be repeated.")
      ->type_name("FILE")
      ->take_all()
      ->allow_extra_args(false);
}

void add_set_option(CLI::App& command, std::vector<std::string>& overrides) {
  command.add_option("--set", overrides, "KEY=VALUE: overrides a key of the scenario.")
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace skein::app
