// SPDX-License-Identifier: Apache-2.0
#include "fuzz/mutate.h"

#include <array>
#include <random>
#include <vector>

#include <nlohmann/json.hpp>
#include <tinyxml2.h>
#include <yaml-cpp/yaml.h>

namespace plotscan::fuzz {
namespace {

using Random = std::minstd_rand;

std::size_t pick(Random& random, std::size_t count) { return random() % count; }

// Numbers at the ends of ranges, lists of too many, texts that are no numbers.
std::string odd_value(Random& random) {
  static const std::array<const char*, 24> values = {"0",      "-1",         "1",
                                                     "1e-300", "1e300",      "nan",
                                                     "inf",    "4294967296", "18446744073709551616",
                                                     "2.5",    "-0",         "",
                                                     "true",   "null",       "a b",
                                                     "..",     "/dev/zero",  "[]",
                                                     "{}",     "1 2",        "65536",
                                                     "1e9",    "\x7f",       "model://a"};
  return values[pick(random, values.size())];
}

// --- JSON ---
using Json = nlohmann::json;

void collect(Json& node, std::vector<Json*>& all) {
  all.push_back(&node);
  if (!node.is_structured()) return;
  for (Json& child : node) collect(child, all);
}

Json odd_json(Random& random) {
  const Json parsed = Json::parse(odd_value(random), nullptr, false);
  return parsed.is_discarded() ? Json(odd_value(random)) : parsed;
}

std::optional<std::string> mutated_json(const std::string& bytes, Random& random) {
  Json tree = Json::parse(bytes, nullptr, false);
  if (tree.is_discarded()) return std::nullopt;
  std::vector<Json*> all;
  collect(tree, all);
  Json& node = *all[pick(random, all.size())];
  const Json other = *all[pick(random, all.size())];
  switch (pick(random, 4)) {
    case 0:
      node = odd_json(random);
      break;
    case 1:
      node = other;
      break;
    case 2:
      if (node.is_array()) node.push_back(other);
      if (node.is_object()) node[odd_value(random)] = other;
      break;
    default:
      if (node.is_structured() && !node.empty()) {
        auto child = node.begin();
        std::advance(child, pick(random, node.size()));
        node.erase(child);
      }
  }
  return tree.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// --- YAML ---
void collect(const YAML::Node& node, std::vector<YAML::Node>& all) {
  all.push_back(node);
  if (node.IsMap()) {
    for (const auto& entry : node) collect(entry.second, all);
  } else if (node.IsSequence()) {
    for (const auto& entry : node) collect(entry, all);
  }
}

void change(YAML::Node node, const YAML::Node& other, Random& random) {
  switch (pick(random, 4)) {
    case 0:
      node = YAML::Node(odd_value(random));
      break;
    case 1:
      node = other;
      break;
    case 2:
      if (node.IsSequence()) node.push_back(other);
      if (node.IsMap()) node[odd_value(random)] = other;
      break;
    default:
      if (node.IsSequence() && node.size() > 0) node.remove(pick(random, node.size()));
      if (node.IsMap() && node.size() > 0) {
        auto entry = node.begin();
        std::advance(entry, pick(random, node.size()));
        node.remove(entry->first);
      }
  }
}

std::optional<std::string> mutated_yaml(const std::string& bytes, Random& random) {
  try {
    const YAML::Node tree = YAML::Load(bytes);
    if (!tree.IsMap() && !tree.IsSequence()) return std::nullopt;
    std::vector<YAML::Node> all;
    collect(tree, all);
    const YAML::Node other = YAML::Clone(all[pick(random, all.size())]);
    change(all[pick(random, all.size())], other, random);
    return YAML::Dump(tree);
  } catch (const YAML::Exception&) {
    return std::nullopt;
  }
}

// --- XML ---
void collect(tinyxml2::XMLElement* element, std::vector<tinyxml2::XMLElement*>& all) {
  all.push_back(element);
  for (auto* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement())
    collect(child, all);
}

void change(tinyxml2::XMLDocument& tree, tinyxml2::XMLElement* node, tinyxml2::XMLElement* other,
            Random& random) {
  const tinyxml2::XMLAttribute* attribute = node->FirstAttribute();
  switch (pick(random, 4)) {
    case 0:
      node->SetText(odd_value(random).c_str());
      break;
    case 1:
      if (attribute != nullptr) node->SetAttribute(attribute->Name(), odd_value(random).c_str());
      break;
    case 2:
      node->InsertEndChild(other->DeepClone(&tree));
      break;
    default:
      if (node != tree.RootElement()) tree.DeleteNode(node);
  }
}

std::optional<std::string> mutated_xml(const std::string& bytes, Random& random) {
  tinyxml2::XMLDocument tree;
  if (tree.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS || !tree.RootElement())
    return std::nullopt;
  std::vector<tinyxml2::XMLElement*> all;
  collect(tree.RootElement(), all);
  change(tree, all[pick(random, all.size())], all[pick(random, all.size())], random);
  tinyxml2::XMLPrinter printer(nullptr, true);
  tree.Print(&printer);
  return std::string(printer.CStr(), static_cast<std::size_t>(printer.CStrSize()) - 1);
}

}  // namespace

std::optional<std::string> mutated(Structure structure, const std::string& bytes,
                                   std::uint32_t seed) {
  Random random(seed);
  switch (structure) {
    case Structure::json:
      return mutated_json(bytes, random);
    case Structure::yaml:
      return mutated_yaml(bytes, random);
    case Structure::xml:
      return mutated_xml(bytes, random);
    default:
      return std::nullopt;
  }
}

}  // namespace plotscan::fuzz
