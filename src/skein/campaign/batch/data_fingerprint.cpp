// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/data_fingerprint.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>
#include <string_view>

#include "skein/base/hash.h"
#include "skein/base/input_file.h"

namespace skein::campaign {
namespace {

namespace fs = std::filesystem;

using Files = std::set<fs::path>;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

Error unread(const fs::path& path, const std::string& reason) {
  return {ErrorCode::kUnavailable, path.string(),
          "cannot be read: " + reason +
              ". Results could not be told from those of other "
              "data.",
          ""};
}

// The regular files that an iterator of folders meets.
template <class Walk>
Result<Files> files_in(const fs::path& folder) {
  Files files;
  std::error_code error;
  for (Walk entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_file(entry->path())) files.insert(entry->path());
  if (error) return unread(folder, error.message());
  return files;
}

// Those of the `beside` files, and files below their folder, that a cell of `table`
// names.
Result<void> add_named(const fs::path& table, const Files& beside, Files& files) {
  const auto text = read_file(table);
  if (!text) return text.error();
  const fs::path folder = table.parent_path();
  constexpr std::string_view kEnds = ",;\"\t\r\n";
  std::string_view rest = text.value();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(kEnds), rest.size());
    const std::string_view cell = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (cell.find('.') == std::string_view::npos) continue;
    const fs::path other = folder / cell;
    // Most cells are numbers: the system is asked about paths into other folders only.
    const bool is_there = cell.find('/') == std::string_view::npos
                              ? beside.contains(other)
                              : is_file(other);
    if (is_there) files.insert(other);
  }
  return {};
}

Result<Files> parts_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    return files_in<fs::recursive_directory_iterator>(path);
  if (!is_file(path)) {
    const bool there = fs::exists(path, error);
    return unread(path, error   ? error.message()
                        : there ? "it is no regular file, and each run reads it"
                                : "there is no such file");
  }
  const auto beside = files_in<fs::directory_iterator>(
      path.has_parent_path() ? path.parent_path() : fs::path("."));
  if (!beside) return beside.error();
  Files files{path};
  for (const fs::path& each : beside.value())
    if (each.stem() == path.stem()) files.insert(each);
  if (path.extension() == ".csv")
    if (auto added = add_named(path, beside.value(), files); !added) return added.error();
  return files;
}

Result<void> add_content(const fs::path& file, Hasher& hasher) {
  auto in = open_input(file);
  if (!in) return in.error();
  std::vector<char> part(std::size_t{1} << 18);
  while (in.value()) {
    in.value().read(part.data(), static_cast<std::streamsize>(part.size()));
    if (in.value().bad()) return unread(file, "reading fails");
    hasher.add(std::as_bytes(
        std::span(part.data(), static_cast<std::size_t>(in.value().gcount()))));
  }
  return {};
}

Result<std::string> hash_of(const fs::path& path) {
  const auto files = parts_of(path);
  if (!files) return files.error();
  Hasher hasher;
  for (const fs::path& file : files.value()) {
    hasher.add(std::string_view(file.filename().string()));
    if (auto added = add_content(file, hasher); !added) return added.error();
  }
  return hasher.hex();
}

}  // namespace

Result<std::string> DataFingerprint::of(const std::vector<std::string>& paths) {
  if (paths.empty()) return std::string();
  Hasher hasher;
  for (const std::string& path : paths) {
    std::string& known = known_[path];
    if (known.empty()) {
      auto hash = hash_of(path);
      if (!hash) return hash.error();
      known = std::move(hash).value();
    }
    hasher.add(std::string_view(known));
  }
  return hasher.hex();
}

}  // namespace skein::campaign
