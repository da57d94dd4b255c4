// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "skein/assemble/kinds/code_consent.h"

namespace skein::app {

/// Whether libraries and programs that scenarios name may run
/// (docs/extending.md#consent). They may when the scenario is one that is shipped with
/// Skein, byte by byte, or lies in a folder of the command line or of the user's file of
/// trusted folders. Else the user is asked, on a terminal; without one it is refused with
/// the option to give.
class Trust final : public assemble::CodeConsent {
 public:
  /// @param folders  of the command line, canonical.
  explicit Trust(std::vector<std::filesystem::path> folders)
      : folders_(std::move(folders)) {}

  /// Scenarios are changed by this file from now on, which must be trusted as well.
  void add_author(const scenario::Source& campaign) { authors_.push_back(campaign); }

  Result<void> library(const std::string& file,
                       const scenario::Source& named_in) override;
  Result<void> programs(const std::vector<std::vector<std::string>>& commands,
                        const scenario::Source& named_in) override;

 private:
  // The first file, of the scenario or an author, that is not trusted; null: all are.
  Result<const scenario::Source*> untrusted(const scenario::Source& named_in) const;
  bool ask(const std::string& question);

  std::vector<std::filesystem::path> folders_;
  std::vector<scenario::Source> authors_;
  std::mutex mutex_;
  std::map<std::string, bool> answers_;  // by question
};

/// The user's file of trusted folders; empty: there is no place for one.
std::filesystem::path trusted_folders_file();

/// SHA-256 of the scenarios and campaigns that are shipped with this program, as 64
/// hexadecimal digits each, in order.
std::vector<std::string_view> shipped_digests();

}  // namespace skein::app
