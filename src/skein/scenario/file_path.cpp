// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/file_path.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "skein/data/command/command_text.h"
#include "skein/scenario/text.h"

namespace skein::scenario {
namespace {

namespace fs = std::filesystem;

// Why there is no such file or folder for us; empty when there is.
std::string file_error(const fs::path& path, bool folder) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return "does not exist";
  if (error) return error.message();
  const bool is_folder = fs::is_directory(status);
  if (folder != is_folder) return is_folder ? "is a folder" : "is not a folder";
  if (::access(path.c_str(), R_OK) != 0) return "may not be read";
  return {};
}

fs::path absolute_path(const fs::path& folder, std::string_view text,
                       std::error_code& error) {
  return fs::absolute(folder / text, error).lexically_normal();
}

// What to write instead of `text`, when it leads somewhere from the working folder only.
std::string other_folder_hint(const fs::path& folder, std::string_view text,
                              bool is_folder) {
  std::error_code error;
  if (folder.empty() || fs::path(text).is_absolute()) return {};
  const fs::path here = absolute_path({}, text, error);
  if (error || !file_error(here, is_folder).empty()) return {};
  const fs::path from = absolute_path(folder, "", error);
  fs::path written = here.lexically_relative(from);
  if (error || written.empty()) written = here;
  return fmt::format(
      "{} of the working folder is not taken: what a file names starts at that file's "
      "folder. Write {}.",
      quote_path(here.string()), quote_path(written.string()));
}

}  // namespace

const fs::path& Folders::of(const Place& place) const {
  static const fs::path working_folder;
  const auto number = static_cast<std::size_t>(place.source);
  return number < by_source.size() ? by_source[number] : working_folder;
}

NamedPath find_file(std::string_view text, const fs::path& folder, const FileType& type) {
  std::error_code failure;
  const fs::path path = absolute_path(folder, text, failure);
  NamedPath named{path.string(), {}, {}};
  const std::string reason = failure ? failure.message() : file_error(path, type.folder);
  if (reason.empty()) return named;
  named.problem = fmt::format("{} {}.", quote_path(named.path), reason);
  named.hint = other_folder_hint(folder, text, type.folder);
  return named;
}

NamedPath find_program(std::string_view text, const fs::path& folder) {
  NamedPath named{std::string(text), {}, {}};
  const bool is_file = text.find('/') != std::string_view::npos;
  if (!is_file || text.front() == '{' || text.front() == '/') return named;
  std::error_code failure;
  named.path = absolute_path(folder, text, failure).string();
  if (failure) named.problem = failure.message() + ".";
  if (fs::exists(named.path, failure)) return named;
  named.hint = other_folder_hint(folder, text, false);
  if (!named.hint.empty())
    named.problem = fmt::format("{} does not exist.", quote_path(named.path));
  return named;
}

NamedPath find_file_of_order(std::string_view text, const fs::path& folder) {
  NamedPath order{std::string(text), {}, {}};
  const auto command = parse_command(text);
  const auto* task = command ? std::get_if<TaskCommand>(&command.value()) : nullptr;
  if (!task || task->file.empty()) return order;
  NamedPath file = find_file(task->file, folder, {});
  if (file.path.find_first_of(" \t\r\n") != std::string::npos) {
    order.problem =
        fmt::format("{} has a space in its path, which a command cannot have.",
                    quote_path(file.path));
    return order;
  }
  // The word after the last "file" that is followed by it.
  for (std::size_t at = text.rfind(task->file); at != std::string_view::npos && at > 0;
       at = text.rfind(task->file, at - 1)) {
    const std::string_view before = text.substr(0, at);
    const std::size_t word = before.find_last_not_of(" \t");
    if (word == std::string_view::npos || word + 1 == at ||
        !before.substr(0, word + 1).ends_with("file"))
      continue;
    order.path =
        fmt::format("{}{}{}", before, file.path, text.substr(at + task->file.size()));
    break;
  }
  order.problem = std::move(file.problem);
  order.hint = std::move(file.hint);
  return order;
}

bool names_yaml_file(std::string_view text) {
  return text.ends_with(".yaml") || text.ends_with(".yml");
}

}  // namespace skein::scenario
