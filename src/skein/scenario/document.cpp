#include "skein/scenario/document.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>

#include "skein/scenario/parse.h"
#include "skein/scenario/read.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

Reading finished(Problems& problems, const Document& document) {
  Reading reading;
  reading.problem_count = problems.count();
  reading.problems = problems.take();
  reading.consequence = document.consequence;
  return reading;
}

// The bytes of a file; an empty optional and a reason when that is impossible.
std::optional<std::string> load(const std::filesystem::path& path,
                                const std::string& name, std::string& reason) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    reason = "there is no such file.";
  } else if (!std::filesystem::exists(status)) {
    reason = fmt::format("cannot be read: {}.", error.message());
  } else if (std::filesystem::is_directory(status)) {
    reason = fmt::format("is a folder, not {} file.", name);
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

std::string Reading::report() const {
  if (problem_count == 0) return {};
  std::string text;
  for (const Problem& problem : problems) text += problem.text() + "\n";
  if (problem_count > problems.size()) {
    text += fmt::format("... and {} more\n", problem_count - problems.size());
  }
  return text + fmt::format("{} problem{}; {}.\n", problem_count,
                            problem_count == 1 ? "" : "s", consequence);
}

Reading read_document(const std::filesystem::path& path, const Document& document,
                      const KindTable& kinds, std::span<const Override> overrides,
                      void* target) {
  std::string reason;
  const auto text = load(path, document.name, reason);
  if (!text) {
    Problems problems({path.string()});
    problems.add({}, "", reason);
    return finished(problems, document);
  }
  return read_document_text(*text, path.string(), path.parent_path(), document, kinds,
                            overrides, target);
}

Reading read_document_text(std::string_view text, const std::string& name,
                           const std::filesystem::path& folder, const Document& document,
                           const KindTable& kinds, std::span<const Override> overrides,
                           void* target) {
  std::vector<std::string> sources = {name};
  for (const Override& change : overrides) sources.push_back("--set " + change.text);
  Problems problems(std::move(sources));

  std::optional<Node> root = parse_yaml(text, 0, document.name, problems);
  if (!root && problems.count() == 0) {
    problems.add({0, 1, 1}, "", "the file is empty.", document.empty_hint);
  }
  if (!root) return finished(problems, document);
  if (root->kind != Node::Kind::kMap) {
    problems.add(root->place, "",
                 fmt::format("{} is a list of keys, as in \"name: x\".", document.name));
    return finished(problems, document);
  }
  std::int32_t source = 0;
  for (const Override& change : overrides) {
    apply_override(change, ++source, *root, problems);
  }
  const Folders folders{folder, {}};
  if (document.prepare && !document.prepare(*root, folders, problems))
    return finished(problems, document);
  std::optional<Places> places;
  if (document.places) places = document.places(*root, kinds);
  Reader reader(kinds, folders, places ? &*places : nullptr, problems);
  reader.read(Type{ObjectType{document.keys}}, *root, target);
  return finished(problems, document);
}

std::string write_document(const Document& document, const void* value,
                           const KindTable& kinds) {
  return to_yaml(to_node(Type{ObjectType{document.keys}}, value, kinds));
}

}  // namespace skein::scenario
