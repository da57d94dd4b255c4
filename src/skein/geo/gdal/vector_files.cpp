// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/gdal/vector_files.h"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <string_view>

namespace skein::geo {
namespace {

namespace fs = std::filesystem;

constexpr vsi_l_offset kMaxText = 500'000'000;  // [bytes]

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

bool is_hidden(const fs::path& member) {
  return std::any_of(member.begin(), member.end(), [](const fs::path& part) {
    const std::string name = part.string();
    return name == "__MACOSX" || name.starts_with('.');
  });
}

// The members of an archive that are datasets, a file geodatabase as one.
std::vector<fs::path> members_of(const std::string& archive) {
  std::set<fs::path> found;
  char** list = VSIReadDirRecursive(archive.c_str());
  for (int i = 0; list != nullptr && list[i] != nullptr; ++i) {
    fs::path dataset;
    bool whole = false;
    for (const fs::path& part : fs::path(list[i])) {
      dataset /= part;
      if (small_ending(part) != ".gdb") continue;
      whole = true;
      break;
    }
    if (!is_hidden(dataset) && (whole || is_vector_name(dataset))) found.insert(dataset);
  }
  CSLDestroy(list);
  return {found.begin(), found.end()};
}

}  // namespace

std::string small_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_vector_name(const fs::path& path) {
  const std::string ending = small_ending(path);
  for (const char* known : {".geojson", ".json", ".shp", ".gpkg", ".kml", ".kmz", ".gml",
                            ".gdb", ".zip", ".fgb"})
    if (ending == known) return true;
  return false;
}

std::vector<std::string> vector_datasets(const std::string& file) {
  if (small_ending(file) != ".zip") return {file};
  const std::string archive = (file.starts_with("/vsi") ? "" : "/vsizip/") + file;
  const std::vector<fs::path> members = members_of(archive);
  const bool in_folder =
      std::any_of(members.begin(), members.end(),
                  [](const fs::path& member) { return member.has_parent_path(); });
  if (!in_folder) return {archive};
  std::vector<std::string> names;
  for (const fs::path& member : members) {
    const std::string ending = small_ending(member);
    const bool nested = ending == ".zip";  // an archive within an archive is left alone
    if (!nested) names.push_back(archive + "/" + member.generic_string());
  }
  return names.empty() ? std::vector<std::string>{archive} : names;
}

bool says_cut_off(const std::string& dataset) {
  const std::string ending = small_ending(dataset);
  if (ending != ".geojson" && ending != ".json") return false;
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(dataset.c_str(), "rb"));
  if (!file) return false;
  VSIFSeekL(file.get(), 0, SEEK_END);
  const vsi_l_offset size = VSIFTellL(file.get());
  if (size > kMaxText) return false;
  VSIFSeekL(file.get(), 0, SEEK_SET);
  std::string text(static_cast<std::size_t>(size), '\0');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  constexpr std::string_view kKey = "\"exceededTransferLimit\"";
  for (std::size_t at = text.find(kKey); at != std::string::npos;
       at = text.find(kKey, at + 1)) {
    const std::size_t value = text.find_first_not_of(" \t\r\n:", at + kKey.size());
    if (value != std::string::npos && text.compare(value, 4, "true") == 0) return true;
  }
  return false;
}

}  // namespace skein::geo
