// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/schemas.h"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "skein/data/describe/json.h"
#include "skein/data/event/live.h"

namespace skein::hmi::foxglove {
namespace {

using Json = nlohmann::ordered_json;

Json of_type(const char* type) {
  return {{"type", type}};
}
Json number() {
  return of_type("number");
}
Json text() {
  return of_type("string");
}

Json object(std::initializer_list<std::pair<const char*, Json>> fields) {
  Json schema = of_type("object");
  for (const auto& [name, field] : fields) schema["properties"][name] = field;
  return schema;
}

Json list(Json of) {
  return {{"type", "array"}, {"items", std::move(of)}};
}

Json time() {
  return object({{"sec", of_type("integer")}, {"nsec", of_type("integer")}});
}
Json vector() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}});
}
Json rotation() {
  return object({{"x", number()}, {"y", number()}, {"z", number()}, {"w", number()}});
}
Json pose() {
  return object({{"position", vector()}, {"orientation", rotation()}});
}
Json colour() {
  return object({{"r", number()}, {"g", number()}, {"b", number()}, {"a", number()}});
}

Json arrow() {
  return object({{"pose", pose()},
                 {"shaft_length", number()},
                 {"shaft_diameter", number()},
                 {"head_length", number()},
                 {"head_diameter", number()},
                 {"color", colour()}});
}
Json line() {
  return object({{"type", of_type("integer")},
                 {"pose", pose()},
                 {"thickness", number()},
                 {"scale_invariant", of_type("boolean")},
                 {"points", list(vector())},
                 {"color", colour()}});
}
Json label() {
  return object({{"pose", pose()},
                 {"billboard", of_type("boolean")},
                 {"font_size", number()},
                 {"scale_invariant", of_type("boolean")},
                 {"color", colour()},
                 {"text", text()}});
}

// Of a described value: the fields of an example of it.
template <class T>
Json schema_of(const T& example) {
  Json schema = object({{"timestamp", time()}});
  const Json values = json::to_json(example);
  for (const auto& [name, value] : values.items())
    schema["properties"][name] = value.is_string()    ? text()
                                 : value.is_boolean() ? of_type("boolean")
                                                      : number();
  return schema;
}

}  // namespace

std::string transforms_schema() {
  const Json transform = object({{"timestamp", time()},
                                 {"parent_frame_id", text()},
                                 {"child_frame_id", text()},
                                 {"translation", vector()},
                                 {"rotation", rotation()}});
  return object({{"transforms", list(transform)}}).dump();
}

std::string scene_schema() {
  const Json deletion =
      object({{"timestamp", time()}, {"type", of_type("integer")}, {"id", text()}});
  const Json entity = object({{"timestamp", time()},
                              {"frame_id", text()},
                              {"id", text()},
                              {"lifetime", time()},
                              {"frame_locked", of_type("boolean")},
                              {"arrows", list(arrow())},
                              {"lines", list(line())},
                              {"texts", list(label())}});
  return object({{"deletions", list(deletion)}, {"entities", list(entity)}}).dump();
}

std::string location_schema() {
  return object({{"timestamp", time()},
                 {"frame_id", text()},
                 {"latitude", number()},
                 {"longitude", number()},
                 {"altitude", number()},
                 {"position_covariance", list(number())},
                 {"position_covariance_type", of_type("integer")}})
      .dump();
}

std::string geojson_schema() {
  return object({{"geojson", text()}}).dump();
}

std::string log_schema() {
  return object({{"timestamp", time()},
                 {"level", of_type("integer")},
                 {"message", text()},
                 {"name", text()},
                 {"file", text()},
                 {"line", of_type("integer")}})
      .dump();
}

std::string aircraft_schema() {
  return schema_of(VehicleView{}).dump();
}

std::string metrics_schema() {
  Json values = of_type("object");
  values["additionalProperties"] = number();
  return object({{"timestamp", time()}, {"mission", text()}, {"values", values}}).dump();
}

std::string clock_schema() {
  return schema_of(RunClock{}).dump();
}

}  // namespace skein::hmi::foxglove
