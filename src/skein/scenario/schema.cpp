// SPDX-License-Identifier: Apache-2.0
#include "skein/scenario/schema.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "skein/scenario/numbers.h"
#include "skein/scenario/units.h"
#include "skein/scenario/write.h"

namespace skein::scenario {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return nullptr;
    case Node::Kind::kPlain:
      return Json::parse(node.text);  // written by to_node: a number, true or false
    case Node::Kind::kText:
      return node.text;
    case Node::Kind::kList: {
      Json list = Json::array();
      for (const Node& item : node.items) list.push_back(to_json(item));
      return list;
    }
    case Node::Kind::kMap:
      break;
  }
  Json map = Json::object();
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    map[node.keys[i].text] = to_json(node.items[i]);
  }
  return map;
}

std::string definition_of(const std::string& role) {
  return "kind-of-" + role;
}

Json object_schema(const Object& object, const Kind* kind);

void put_range(Json& schema, const Range& range) {
  if (std::isfinite(range.above)) schema["exclusiveMinimum"] = range.above;
  if (std::isfinite(range.at_least)) schema["minimum"] = range.at_least;
  if (std::isfinite(range.below)) schema["exclusiveMaximum"] = range.below;
  if (std::isfinite(range.at_most)) schema["maximum"] = range.at_most;
}

// Places besides local metres: places.h.
Json geographic() {
  const auto degrees = [](double most) {
    return Json{{"type", "number"}, {"minimum", -most}, {"maximum", most}};
  };
  return {
      {"type", "object"},
      {"properties", {{"latitude_deg", degrees(90)}, {"longitude_deg", degrees(180)}}},
      {"required", {"latitude_deg", "longitude_deg"}},
      {"additionalProperties", false}};
}

Json feature() {
  const Json text = {{"type", Json::array({"string", "number"})}};
  return {{"type", "object"},
          {"properties", {{"feature", text}, {"file", {{"type", "string"}}}}},
          {"required", Json::array({"file"})},
          {"additionalProperties", false}};
}

struct ToSchema {
  Json operator()(const NumberType& type) const {
    Json schema = {{"type", "number"}};
    put_range(schema, type.range);
    return schema;
  }
  Json operator()(const IntegerType& type) const {
    return {{"type", "integer"},
            {"minimum", type.range.at_least},
            {"maximum", type.range.at_most}};
  }
  Json operator()(const BooleanType&) const { return {{"type", "boolean"}}; }
  Json operator()(const TextType& type) const {
    if (type.utc) {
      return {{"type", "string"},
              {"pattern", R"(^\d{4}-\d{2}-\d{2}T\d{2}:\d{2}:\d{2}Z$)"}};
    }
    // A number without quotation marks is good text as well: `name: 12`.
    if (type.allowed.empty()) return {{"type", Json::array({"string", "number"})}};
    return {{"enum", type.allowed}};
  }
  Json operator()(const WordType& type) const {
    Json words = Json::array();
    for (const WordType::Word& word : type.words) {
      words.push_back({{"const", word.name}, {"description", word.help}});
    }
    return {{"oneOf", std::move(words)}};
  }
  Json operator()(const PointType& type) const {
    Json part = {{"type", "number"}};
    put_range(part, type.range);
    const Json pair = {
        {"type", "array"}, {"items", part}, {"minItems", 2}, {"maxItems", 2}};
    return type.place ? Json{{"anyOf", {pair, geographic(), feature()}}} : pair;
  }
  Json operator()(const FileType& type) const {
    Json schema = {{"type", "string"}};
    if (!type.may_be_empty) schema["minLength"] = 1;
    return schema;
  }
  Json operator()(const ListType& type) const {
    Json schema = {{"type", "array"}, {"items", std::visit(*this, type.element->what)}};
    if (type.count.at_least > 0) schema["minItems"] = type.count.at_least;
    if (type.count.at_most != Count{}.at_most) schema["maxItems"] = type.count.at_most;
    const auto* point = std::get_if<PointType>(&type.element->what);
    return point && point->place ? Json{{"anyOf", {schema, feature()}}} : schema;
  }
  Json operator()(const OptionalType& type) const {
    return {{"anyOf", {std::visit(*this, type.inner->what), {{"type", "null"}}}}};
  }
  Json operator()(const ObjectType& type) const {
    return object_schema(*type.object, nullptr);
  }
  Json operator()(const ChoiceType& type) const {
    return {{"$ref", "#/$defs/" + definition_of(type.role)}};
  }
};

bool has_own_default(const Type& type) {
  return !std::holds_alternative<ObjectType>(type.what) &&
         !std::holds_alternative<ChoiceType>(type.what);
}

// Whether a default can be written without knowing any kind.
bool is_free_of_choices(const Type& type) {
  if (const auto* list = std::get_if<ListType>(&type.what)) {
    return is_free_of_choices(*list->element);
  }
  if (const auto* optional = std::get_if<OptionalType>(&type.what)) {
    return is_free_of_choices(*optional->inner);
  }
  return has_own_default(type);
}

Json object_schema(const Object& object, const Kind* kind) {
  Json properties = Json::object();
  Json required = Json::array();
  if (kind) {
    properties["kind"] = {{"const", kind->name}};
    required.push_back("kind");
  }
  const KindTable no_kinds;
  for (const Field& field : object.fields) {
    Json schema = std::visit(ToSchema{}, field.type->what);
    const auto unit = unit_of(field.key);
    schema["description"] =
        field.help + (unit ? " [" + std::string(unit->symbol) + "]" : "");
    if (field.required) {
      required.push_back(field.key);
    } else if (is_free_of_choices(*field.type)) {
      schema["default"] =
          to_json(to_node(*field.type, field.in(object.defaults()), no_kinds));
    }
    properties[field.key] = std::move(schema);
  }
  Json schema = {{"type", "object"}, {"additionalProperties", false}};
  schema["properties"] = std::move(properties);
  if (!required.empty()) schema["required"] = std::move(required);
  return schema;
}

Json choice_schema(const std::vector<Kind>& kinds) {
  Json any = Json::array();
  for (const Kind& kind : kinds) {
    any.push_back({{"const", kind.name}, {"description", kind.help}});
    Json keys = object_schema(*kind.options, &kind);
    keys["description"] = kind.help;
    any.push_back(std::move(keys));
  }
  return {{"oneOf", std::move(any)}};
}

void collect_roles(const Object& object, std::vector<std::string>& roles);

void collect_roles(const Type& type, std::vector<std::string>& roles) {
  if (const auto* list = std::get_if<ListType>(&type.what)) {
    collect_roles(*list->element, roles);
  } else if (const auto* optional = std::get_if<OptionalType>(&type.what)) {
    collect_roles(*optional->inner, roles);
  } else if (const auto* nested = std::get_if<ObjectType>(&type.what)) {
    collect_roles(*nested->object, roles);
  } else if (const auto* choice = std::get_if<ChoiceType>(&type.what)) {
    roles.push_back(choice->role);
  }
}

void collect_roles(const Object& object, std::vector<std::string>& roles) {
  for (const Field& field : object.fields) collect_roles(*field.type, roles);
}

}  // namespace

std::string schema_text(const Document& document, const KindTable& kinds) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", document.title}};
  schema.update(object_schema(*document.keys, nullptr));
  std::vector<std::string> roles = kinds.roles();
  collect_roles(*document.keys, roles);
  Json definitions = Json::object();
  for (const std::string& role : roles) {
    if (definitions.contains(definition_of(role))) continue;
    // A role without kinds accepts nothing.
    definitions[definition_of(role)] = kinds.of(role).empty()
                                           ? Json{{"not", Json::object()}}
                                           : choice_schema(kinds.of(role));
  }
  schema["$defs"] = std::move(definitions);
  return schema.dump(2) + "\n";
}

}  // namespace skein::scenario
