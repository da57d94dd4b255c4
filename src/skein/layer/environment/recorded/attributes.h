// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/layer/environment/recorded/vector_layer.h"

namespace skein::environment {

/// Names as they are compared: small letters and digits only.
using KnownNames = std::span<const std::string_view>;

/// Letters and digits of a name, small.
std::string bare_name(const std::string& name);

/// In capital letters, without spaces at the end.
std::string in_capitals(std::string text);

/// Whether an attribute is the known one: perhaps with the prefix `poly_` or `attr_`,
/// perhaps cut to ten letters as in a shapefile.
bool is_named(const std::string& attribute, std::string_view known);

/// The attribute of that very name; null: there is none.
const Attribute* find_attribute(const VectorFeature& feature, const std::string& name);

/// The attribute with the first of the known names that there is; null: there is none.
const Attribute* find_known(const VectorFeature& feature, KnownNames known);

/// The file that a feature is from, by its place.
std::string file_of(const VectorFeature& feature);

/// What was assumed about a source, each thing once.
class Assumptions {
 public:
  void add(const std::string& what);
  const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
};

}  // namespace skein::environment
