// SPDX-License-Identifier: Apache-2.0
#include "app/scenario/file_format.h"

#include <algorithm>
#include <array>

#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/radio/radio_fields.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/assemble/relay/relay_profile.h"
#include "skein/campaign/campaign/campaign_file.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/scenario.h"

namespace skein::app {
namespace {

constexpr std::array<std::string_view, 4> kOthers = {"aircraft", "radio", "relay",
                                                     "campaign"};

std::ptrdiff_t known_keys(const scenario::Object& object, const scenario::Node& root) {
  return std::ranges::count_if(root.keys, [&](const scenario::Node::Key& key) {
    return object.find(key.text) || object.find_former(key.text);
  });
}

}  // namespace

const scenario::Document* document_of(std::string_view name) {
  if (name == "aircraft") return &assemble::aircraft_document();
  if (name == "radio") return &assemble::radio_document();
  if (name == "relay") return &assemble::relay_document();
  if (name == "campaign") return &campaign::campaign_document();
  return nullptr;
}

scenario::KindTable table_of(std::string_view document,
                             const assemble::KindRegistry& kinds) {
  return document == "radio" ? assemble::radio_table(kinds.kinds())
                             : scenario::KindTable();
}

std::string_view format_of(std::string_view text) {
  scenario::Problems ignored({"text"});
  const auto root = scenario::parse_yaml(text, 0, "a file", ignored);
  std::string_view best = "scenario";
  if (!root) return best;
  auto most = known_keys(*scenario::scenario_fields().description(), *root);
  for (const std::string_view name : kOthers) {
    const auto known = known_keys(*document_of(name)->keys, *root);
    if (known <= most) continue;
    most = known;
    best = name;
  }
  return best;
}

}  // namespace skein::app
