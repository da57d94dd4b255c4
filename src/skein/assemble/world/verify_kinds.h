// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/role/contract/contract.h"

namespace skein::assemble {

/// How a kind, with its default options, stands to the contract of its role.
struct KindVerdict {
  std::string role, kind;
  /// Why it was not put to the test, as a kind that needs a file; empty: it was.
  std::string not_tested;
  contract::Violations violations;
};

/// Puts kinds to the test (role/contract/contract.h), with default options.
/// @param role  only those of this role; empty: of all roles.
/// @param of_plugins  only those that came with plugins.
/// Cost: seconds, for all of Skein's own.
std::vector<KindVerdict> verify_kinds(const KindRegistry& kinds, const std::string& role,
                                      bool of_plugins);

}  // namespace skein::assemble
