#include "scenario/scenario_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "scenario/markdown.h"
#include "scenario/parse.h"
#include "scenario/read.h"
#include "scenario/schema.h"
#include "scenario/write.h"

namespace skein::scenario {
namespace {

Type scenario_type() {
  return {ObjectType{scenario_fields().description()}};
}

ReadOutcome failed(Problems& problems) {
  ReadOutcome outcome;
  outcome.problem_count = problems.count();
  outcome.problems = problems.take();
  return outcome;
}

// The bytes of a file; an empty optional and a reason when that is impossible.
std::optional<std::string> load(const std::filesystem::path& path, std::string& reason) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    reason = "there is no such file.";
  } else if (!std::filesystem::exists(status)) {
    reason = fmt::format("cannot be read: {}.", error.message());
  } else if (std::filesystem::is_directory(status)) {
    reason = "is a folder, not a scenario file.";
  } else {
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
      reason = fmt::format("cannot be read: {}.", std::strerror(errno));
      return std::nullopt;
    }
    std::string text(ParseLimits::kBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
    if (stream.eof()) return text;
    reason = stream ? fmt::format("more than {} bytes.", ParseLimits::kBytes)
                    : "cannot be read.";
  }
  return std::nullopt;
}

}  // namespace

std::string ReadOutcome::report() const {
  if (problem_count == 0) return {};
  std::string text;
  for (const Problem& problem : problems) text += problem.text() + "\n";
  if (problem_count > problems.size()) {
    text += fmt::format("... and {} more\n", problem_count - problems.size());
  }
  return text + fmt::format("{} problem{}; nothing was run.\n", problem_count,
                            problem_count == 1 ? "" : "s");
}

ReadOutcome read_scenario(const std::filesystem::path& path, const KindTable& kinds,
                          std::span<const Override> overrides) {
  std::string reason;
  const auto text = load(path, reason);
  if (!text) {
    Problems problems({path.string()});
    problems.add({}, "", reason);
    return failed(problems);
  }
  return read_scenario_text(*text, path.string(), path.parent_path(), kinds, overrides);
}

ReadOutcome read_scenario_text(std::string_view text, const std::string& name,
                               const std::filesystem::path& folder,
                               const KindTable& kinds,
                               std::span<const Override> overrides) {
  std::vector<std::string> sources = {name};
  for (const Override& change : overrides) sources.push_back("--set " + change.text);
  Problems problems(std::move(sources));

  std::optional<Node> root = parse_yaml(text, 0, problems);
  if (!root && problems.count() == 0) {
    problems.add({0, 1, 1}, "", "the file is empty.",
                 "Give it a key, as in \"name: first-flight\"; all have defaults.");
  }
  if (!root) return failed(problems);
  if (root->kind != Node::Kind::kMap) {
    problems.add(root->place, "", "a scenario is a list of keys, as in \"name: x\".");
    return failed(problems);
  }
  std::int32_t source = 0;
  for (const Override& change : overrides) {
    apply_override(change, ++source, *root, problems);
  }
  ReadOutcome outcome;
  Scenario scenario;
  Reader(kinds, {folder, {}}, problems).read(scenario_type(), *root, &scenario);
  if (problems.count() > 0) return failed(problems);
  outcome.scenario = std::move(scenario);
  return outcome;
}

std::string write_scenario(const Scenario& scenario, const KindTable& kinds) {
  return to_yaml(to_node(scenario_type(), &scenario, kinds));
}

std::string json_schema(const KindTable& kinds) {
  return schema_text(*scenario_fields().description(), kinds);
}

std::string markdown_keys(const KindTable& kinds) {
  return keys_as_markdown(*scenario_fields().description(), kinds);
}

}  // namespace skein::scenario
