// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/places.h"

#include <utility>

#include "skein/scenario/numbers.h"

namespace skein::scenario {

FeatureReader remembering(FeatureReader reader, std::shared_ptr<FeatureMemory> memory) {
  return [reader = std::move(reader), memory = std::move(memory)](
             const std::string& file, const std::string& name, FeatureUse use,
             const geo::LocalFrame& frame) {
    const geo::Geodetic& at = frame.origin();
    const FeatureMemory::key_type key{
        file, name, use, at.latitude_deg, at.longitude_deg, at.height_m};
    auto known = memory->find(key);
    if (known == memory->end())
      known = memory->emplace(key, reader(file, name, use, frame)).first;
    return known->second;
  };
}

std::optional<geo::LocalFrame> frame_of(const Node& root,
                                        const geo::Geodetic& default_origin) {
  geo::Geodetic origin = default_origin;
  const auto take = [](const Node* node, double& value) {
    if (!node) return true;
    const auto number = parse_number(node->text);
    if (node->kind == Node::Kind::kPlain && number) value = *number;
    return node->kind == Node::Kind::kPlain && number.has_value();
  };
  if (const Node* given = root.find("origin"))
    if (!take(given->find("latitude_deg"), origin.latitude_deg) ||
        !take(given->find("longitude_deg"), origin.longitude_deg))
      return std::nullopt;
  auto frame = geo::LocalFrame::at(origin);
  if (!frame) return std::nullopt;
  return std::move(frame).value();
}

}  // namespace skein::scenario
