// SPDX-License-Identifier: Apache-2.0
#include "app/common/trust.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/sha.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "app/common/common.h"
#include "app/common/question.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;
using scenario::Source;

constexpr off_t kMaxTrustBytes = 1 << 20;  // of the file of trusted folders

std::string sha256_hex(std::string_view text) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest);
  std::string hex;
  for (const unsigned char byte : digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

bool is_shipped(const Source& source) {
  if (!source.text) return false;
  const auto all = shipped_digests();
  return std::find(all.begin(), all.end(), sha256_hex(*source.text)) != all.end();
}

// Both without symbolic links.
bool is_inside(const fs::path& path, const fs::path& folder) {
  const auto [end, rest] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && rest != path.end();
}

bool lies_in(const Source& source, const std::vector<fs::path>& folders) {
  if (source.file.empty() || source.folder.empty()) return false;
  return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
    // Where its relative paths start counts too: a link to the file may lie elsewhere.
    return is_inside(source.file, folder) && is_inside(source.folder / ".", folder);
  });
}

class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : id_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~OpenFile() {
    if (id_ >= 0) ::close(id_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int id() const { return id_; }

 private:
  int id_;
};

Error trust_error(const fs::path& file, std::string message, std::string hint = {}) {
  return {ErrorCode::kBadInput, file.string(), std::move(message), std::move(hint)};
}

// The text of the file of trusted folders, if nobody but the user can have written it;
// empty without such a file.
Result<std::string> read_trusted(const fs::path& file) {
  const OpenFile opened(file);
  if (opened.id() < 0) {
    if (errno == ENOENT || errno == ENOTDIR) return std::string();
    return trust_error(file, fmt::format("cannot be read: {}.", std::strerror(errno)));
  }
  struct stat status {};
  if (::fstat(opened.id(), &status) != 0 || !S_ISREG(status.st_mode))
    return trust_error(file, "is not a regular file; no folder of it is trusted.");
  if (status.st_uid != ::geteuid())
    return trust_error(file, "belongs to somebody else; no folder of it is trusted.");
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return trust_error(file, "can be written by others; no folder of it is trusted.",
                       "Give it the permissions 600.");
  if (status.st_size > kMaxTrustBytes) return trust_error(file, "is too long.");
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t size = ::read(opened.id(), text.data(), text.size());
  if (size < 0)
    return trust_error(file, fmt::format("cannot be read: {}.", std::strerror(errno)));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

// One absolute path a line; # begins a comment line. Folders that are not there, of
// another machine for instance, are passed over.
Result<std::vector<fs::path>> user_folders() {
  const fs::path file = trusted_folders_file();
  std::vector<fs::path> folders;
  if (file.empty()) return folders;
  const auto text = read_trusted(file);
  if (!text) return text.error();
  std::string_view rest = text.value();
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    if (line.front() != '/')
      return trust_error(file,
                         fmt::format("line {} is no absolute path of a folder.", number));
    std::error_code error;
    fs::path folder = fs::canonical(line, error);
    if (!error && fs::is_directory(folder, error)) folders.push_back(std::move(folder));
  }
  return folders;
}

std::string file_of(const Source& source) {
  return source.file.empty() ? "the scenario" : source.file.string();
}

// What to give, so that code named by `source` runs.
std::string trust_hint(const Source& source) {
  if (source.file.empty()) return "Write it to a file in a folder that you trust.";
  const std::string folder = source.file.parent_path().string();
  std::string hint = fmt::format("--trust {}", shell_quoted(folder));
  if (source.folder != source.file.parent_path())
    hint += fmt::format(" --trust {}", shell_quoted(source.folder.string()));
  const fs::path file = trusted_folders_file();
  if (file.empty()) return hint + ".";
  return fmt::format("{}; for good, a line {} in {}.", hint, folder, file.string());
}

std::string words_of(const std::vector<std::vector<std::string>>& commands) {
  std::string text;
  for (const auto& command : commands) {
    text += text.empty() ? "" : " and ";
    for (std::size_t k = 0; k < command.size(); ++k)
      text += (k == 0 ? "" : " ") + shell_quoted(command[k]);
  }
  return text;
}

}  // namespace

fs::path trusted_folders_file() {
  const auto absolute = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value && value[0] == '/' ? fs::path(value) : fs::path();
  };
  fs::path configuration = absolute("XDG_CONFIG_HOME");
  if (configuration.empty()) {
    const fs::path home = absolute("HOME");
    if (home.empty()) return {};
    configuration = home / ".config";
  }
  return configuration / "skein" / "trusted-folders";
}

Result<const Source*> Trust::untrusted(const Source& named_in) const {
  std::vector<const Source*> authors = {&named_in};
  for (const Source& author : authors_) authors.push_back(&author);
  std::erase_if(authors, [this](const Source* author) {
    return is_shipped(*author) || lies_in(*author, folders_);
  });
  if (authors.empty()) return nullptr;
  const auto folders = user_folders();
  if (!folders) return folders.error();
  for (const Source* author : authors)
    if (!lies_in(*author, folders.value())) return author;
  return nullptr;
}

bool Trust::ask(const std::string& question) {
  const std::lock_guard lock(mutex_);
  const auto known = answers_.find(question);
  if (known != answers_.end()) return known->second;
  const bool yes = ask_on_terminal(question);
  answers_[question] = yes;
  return yes;
}

Result<void> Trust::library(const std::string& file, const Source& named_in) {
  const auto author = untrusted(named_in);
  if (!author) return author.error();
  if (author.value() == nullptr) return {};
  const std::string where = file_of(*author.value());
  if (ask(fmt::format("{} wants to load the library {}, whose code then runs as you. "
                      "Load it?",
                      where, file)))
    return {};
  return trust_error(
      file,
      fmt::format("is not loaded: a library is code that runs as you, and {}, which "
                  "names it, is in no folder that you trust.",
                  where),
      fmt::format("If you trust it, give --plugin {}; if all that is in the folder, {}",
                  shell_quoted(file), trust_hint(*author.value())));
}

Result<void> Trust::programs(const std::vector<std::vector<std::string>>& commands,
                             const Source& named_in) {
  const auto author = untrusted(named_in);
  if (!author) return author.error();
  if (author.value() == nullptr) return {};
  const std::string where = file_of(*author.value());
  const std::string text = words_of(commands);
  if (ask(fmt::format("{} wants to start as you: {}. Start it?", where, text))) return {};
  return trust_error(
      where,
      fmt::format("wants to start {}, and is in no folder that you trust: "
                  "nothing is started.",
                  text),
      fmt::format("If you trust it, give {}", trust_hint(*author.value())));
}

}  // namespace skein::app
