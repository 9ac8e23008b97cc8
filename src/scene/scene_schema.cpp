#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/key_catalogue.h"
#include "scene/reference.h"

namespace brisance {
namespace {

using Json = nlohmann::ordered_json;
using Type = CatalogueEntry::Type;

Json valueOf(const SceneNode& node) {
  switch (node.kind) {
    case SceneNode::Kind::flag:
      return node.flag;
    case SceneNode::Kind::integer:
      return node.integer;
    // Through the shortest text of a float, so that 0.7f is 0.7 here too.
    case SceneNode::Kind::number:
      return Json::parse(shownValue(node));
    case SceneNode::Kind::array: {
      Json array = Json::array();
      for (const SceneNode& child : node.children) array.push_back(valueOf(child));
      return array;
    }
    default:
      return node.text;
  }
}

Json numberSchema(const CatalogueEntry& entry) {
  Json schema{{"type", entry.type == Type::integer ? "integer" : "number"}};
  const Range& range = entry.key.range;
  if (std::isfinite(range.low)) schema[range.lowIncluded ? "minimum" : "exclusiveMinimum"] = range.low;
  if (std::isfinite(range.high)) schema["maximum"] = range.high;
  if (entry.count == 1) return schema;
  return {{"type", "array"}, {"items", schema}, {"minItems", entry.count}, {"maxItems", entry.count}};
}

Json placesSchema() {
  const Json place{{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
  return {{"type", "array"}, {"items", place}};
}

Json tableSchema(const std::vector<CatalogueEntry>& keys, const Json& type);

Json tableOrTypes(const CatalogueEntry& entry) {
  if (entry.names.empty()) return tableSchema(entry.children, nullptr);
  Json kinds = Json::array();
  for (std::size_t i = 0; i < entry.names.size(); ++i)
    kinds.push_back(tableSchema(entry.alternatives[i], entry.names[i]));
  if (entry.typeAlone) kinds.push_back({{"enum", entry.names}});
  return {{"anyOf", kinds}};
}

Json schemaOf(const CatalogueEntry& entry) {
  switch (entry.type) {
    case Type::flag:
      return {{"type", "boolean"}};
    case Type::integer:
    case Type::number:
      return numberSchema(entry);
    case Type::places:
      return placesSchema();
    case Type::text:
    case Type::file:
      return {{"type", "string"}, {"minLength", 1}};
    case Type::choice:
      return {{"enum", entry.names}};
    case Type::array:
      return {{"type", "array"}, {"items", tableOrTypes(entry)}};
    case Type::table:
      return tableOrTypes(entry);
  }
  return {};
}

std::string description(const CatalogueEntry& entry) {
  std::string text = entry.key.doc;
  if (*entry.key.unit != 0) text += std::string(" [") + entry.key.unit + "]";
  if (entry.optional) text += std::string("; not written: ") + entry.key.fallback;
  return text;
}

/// An object of the given keys; `type` names the alternative it is, or is null.
Json tableSchema(const std::vector<CatalogueEntry>& keys, const Json& type) {
  Json properties = Json::object(), required = Json::array();
  if (!type.is_null()) properties["type"] = {{"const", type}};
  for (const CatalogueEntry& entry : keys) {
    Json schema = schemaOf(entry);
    schema["description"] = description(entry);
    const bool plainValue = entry.type != Type::table && entry.type != Type::array;
    if (plainValue && !entry.optional && !entry.key.required) schema["default"] = valueOf(entry.value);
    if (entry.key.required) required.push_back(entry.key.name);
    properties[entry.key.name] = schema;
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

}  // namespace

std::string sceneSchema() {
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Brisance scene"}};
  schema.update(tableSchema(catalogueOfKeys().children, nullptr));
  return schema.dump(2) + "\n";
}

}  // namespace brisance
