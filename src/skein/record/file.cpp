#include "skein/record/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace skein::record {

Result<void> write_file(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path unfinished = file.string() + ".part";
  errno = 0;
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  std::error_code failed;
  if (out) {
    std::filesystem::rename(unfinished, file, failed);
    if (!failed) return {};
  }
  const std::string reason = failed ? failed.message() : std::strerror(errno);
  std::filesystem::remove(unfinished, failed);
  return Error{ErrorCode::kUnavailable, file.string(),
               "the file cannot be written: " + reason, "check the place and its room"};
}

}  // namespace skein::record
