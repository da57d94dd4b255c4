// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/attributes.h"

#include <algorithm>
#include <cctype>

namespace skein::environment {

std::string bare_name(const std::string& name) {
  std::string result;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string in_capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool is_named(const std::string& attribute, std::string_view known) {
  const std::string name = bare_name(attribute);
  for (const char* prefix : {"", "poly", "attr"}) {
    const std::string whole = prefix + std::string(known);
    if (name == whole) return true;
    if (attribute.size() == 10 && name.size() >= 8 && whole.starts_with(name))
      return true;
  }
  return false;
}

const Attribute* find_attribute(const VectorFeature& feature, const std::string& name) {
  for (const Attribute& each : feature.attributes)
    if (each.name == name) return &each;
  return nullptr;
}

const Attribute* find_known(const VectorFeature& feature, KnownNames known) {
  for (const std::string_view name : known)
    for (const Attribute& each : feature.attributes)
      if (is_named(each.name, name)) return &each;
  return nullptr;
}

std::string file_of(const VectorFeature& feature) {
  return feature.outline.place.substr(0, feature.outline.place.rfind(": feature"));
}

void Assumptions::add(const std::string& what) {
  const std::string line = "assumed: " + what;
  if (std::find(all_.begin(), all_.end(), line) == all_.end()) all_.push_back(line);
}

}  // namespace skein::environment
