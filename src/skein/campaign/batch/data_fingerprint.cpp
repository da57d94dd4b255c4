// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/data_fingerprint.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <span>

#include "skein/base/hash.h"

namespace skein::campaign {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Files beside `table` that a cell of it names.
void add_named(const fs::path& table, std::set<fs::path>& files) {
  std::ifstream in(table);
  std::string cell;
  const auto take = [&] {
    const fs::path other = table.parent_path() / cell;
    if (cell.find('.') != std::string::npos && is_file(other)) files.insert(other);
    cell.clear();
  };
  for (char c = 0; in.get(c);)
    if (c == ',' || c == ';' || c == '"' || c == '\t' || c == '\r' || c == '\n')
      take();
    else
      cell += c;
  take();
}

std::set<fs::path> parts_of(const fs::path& path) {
  std::set<fs::path> files;
  std::error_code error;
  if (fs::is_directory(path, error)) {
    using Walk = fs::recursive_directory_iterator;
    for (Walk entry(path, error), end; !error && entry != end; entry.increment(error))
      if (is_file(entry->path())) files.insert(entry->path());
    return files;
  }
  files.insert(path);
  fs::directory_iterator entry(path.parent_path(), error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().stem() == path.stem() && is_file(entry->path()))
      files.insert(entry->path());
  if (path.extension() == ".csv") add_named(path, files);
  return files;
}

std::string hash_of(const fs::path& path) {
  Hasher hasher;
  std::vector<char> part(std::size_t{1} << 18);
  for (const fs::path& file : parts_of(path)) {
    hasher.add(std::string_view(file.filename().string()));
    std::ifstream in(file, std::ios::binary);
    while (in) {
      in.read(part.data(), static_cast<std::streamsize>(part.size()));
      hasher.add(
          std::as_bytes(std::span(part.data(), static_cast<std::size_t>(in.gcount()))));
    }
  }
  return hasher.hex();
}

}  // namespace

std::string DataFingerprint::of(const std::vector<std::string>& paths) {
  if (paths.empty()) return {};
  Hasher hasher;
  for (const std::string& path : paths) {
    std::string& hash = known_[path];
    if (hash.empty()) hash = hash_of(path);
    hasher.add(std::string_view(hash));
  }
  return hasher.hex();
}

}  // namespace skein::campaign
