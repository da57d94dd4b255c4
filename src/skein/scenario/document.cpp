// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/document.h"

#include <fmt/format.h>

#include <cstring>
#include <optional>
#include <system_error>

#include "skein/base/input_file.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/read.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

Reading finished(Problems& problems, const Document& document) {
  Reading reading;
  reading.problem_count = problems.count();
  reading.problems = problems.take();
  reading.renames = problems.take_renames();
  reading.consequence = document.consequence;
  return reading;
}

// The bytes of a file; an empty optional and a reason when that is impossible.
std::optional<std::string> load(const std::filesystem::path& path,
                                const std::string& name, std::string& reason) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    reason = fmt::format("is a folder, not {} file.", name);
    return std::nullopt;
  }
  auto text = read_file(path, ParseLimits::kBytes);
  if (text) return std::move(text).value();
  reason = text.error().message;
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

namespace {

// Symbolic links resolved, so that relative paths start where Source says, whatever
// becomes of links meanwhile. One that is not there stays as it is.
std::filesystem::path start_of_paths(const std::filesystem::path& folder) {
  if (folder.empty()) return folder;
  std::error_code error;
  auto canonical = std::filesystem::canonical(folder, error);
  return error ? folder : canonical;
}

// `opened` has what is known of the text already.
Reading read_text(const OpenedDocument& opened, const Document& document,
                  const KindTable& kinds, std::span<const Override> overrides,
                  void* target) {
  std::vector<std::string> sources = {opened.name};
  Folders folders;
  folders.by_source.push_back(opened.source.folder);
  for (const Override& change : overrides) {
    sources.push_back("--set " + change.text);
    folders.by_source.push_back(change.folder);
  }
  folders.source = opened.source;
  Problems problems(std::move(sources));
  const auto finish = [&] {
    Reading reading = finished(problems, document);
    reading.source = folders.source;
    return reading;
  };

  std::optional<Node> root =
      opened.root ? std::optional<Node>(*opened.root)
                  : parse_yaml(*opened.source.text, 0, document.name, problems);
  if (!root && problems.count() == 0) {
    problems.add({0, 1, 1}, "", "the file is empty.", document.empty_hint);
  }
  if (!root) return finish();
  if (root->kind != Node::Kind::kMap) {
    problems.add(root->place, "",
                 fmt::format("{} is a list of keys, as in \"name: x\".", document.name));
    return finish();
  }
  std::int32_t number = 0;
  for (const Override& change : overrides)
    apply_override(change, ++number, *root, problems);
  if (document.prepare && !document.prepare(*root, folders, problems)) return finish();
  std::optional<Places> places;
  if (document.places) places = document.places(*root, kinds);
  if (places && places->features && opened.features)
    places->features = remembering(std::move(places->features), opened.features);
  const Reader::Care care =
      document.says_only ? Reader::Care::kWhatItSays : Reader::Care::kAll;
  Reader reader(kinds, folders, places ? &*places : nullptr, problems, care);
  reader.read(Type{ObjectType{document.keys}}, *root, target);
  return finish();
}

}  // namespace

OpenedDocument open_document(const std::filesystem::path& path,
                             const Document& document) {
  // What is opened is what Source names, whatever becomes of links meanwhile.
  std::error_code no_file, no_folder;
  const auto file = std::filesystem::canonical(path, no_file);
  const auto folder = std::filesystem::absolute(path, no_folder).parent_path();
  OpenedDocument opened;
  opened.name = path.string();
  auto text = load(no_file ? path : file, document.name, opened.failure);
  if (!text) return opened;
  opened.source = {file, start_of_paths(folder),
                   std::make_shared<const std::string>(*std::move(text))};
  return opened;
}

Reading read_document(const OpenedDocument& file, const Document& document,
                      const KindTable& kinds, std::span<const Override> overrides,
                      void* target) {
  if (file.source.text) return read_text(file, document, kinds, overrides, target);
  Problems problems({file.name});
  problems.add({}, "", file.failure);
  return finished(problems, document);
}

Reading read_document(const std::filesystem::path& path, const Document& document,
                      const KindTable& kinds, std::span<const Override> overrides,
                      void* target) {
  return read_document(open_document(path, document), document, kinds, overrides, target);
}

void keep_parsed(OpenedDocument& file, const Document& document) {
  file.features = std::make_shared<FeatureMemory>();
  if (!file.source.text) return;
  Problems problems({file.name});
  auto root = parse_yaml(*file.source.text, 0, document.name, problems);
  if (root && problems.count() == 0)
    file.root = std::make_shared<const Node>(*std::move(root));
}

Reading read_document_text(std::string_view text, const std::string& name,
                           const std::filesystem::path& folder, const Document& document,
                           const KindTable& kinds, std::span<const Override> overrides,
                           void* target) {
  OpenedDocument opened;
  opened.name = name;
  opened.source = {{}, start_of_paths(folder), std::make_shared<const std::string>(text)};
  return read_text(opened, document, kinds, overrides, target);
}

std::string write_document(const Document& document, const void* value,
                           const KindTable& kinds) {
  return to_yaml(to_node(Type{ObjectType{document.keys}}, value, kinds));
}

}  // namespace skein::scenario
