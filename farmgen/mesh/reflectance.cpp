// SPDX-License-Identifier: Apache-2.0
#include "mesh/reflectance.h"

#include <array>
#include <cctype>

#include "core/text.h"

namespace plotscan::mesh {
namespace {

struct Word {
  std::string_view text;
  float reflectance;
};

constexpr float kStem = 0.40F;
constexpr float kEar = 0.40F;
constexpr float kDry = 0.50F;

// The first that a name holds decides: "dry_leaf" is dry, "ripe_ear" an ear.
constexpr std::array<Word, 27> kWords = {{
    {"soil", kSoilReflectance},
    {"terrain", kSoilReflectance},
    {"ground", kSoilReflectance},
    {"dry", kDry},
    {"straw", kDry},
    {"dead", kDry},
    {"senescent", kDry},
    {"ear", kEar},
    {"spike", kEar},
    {"panicle", kEar},
    {"awn", kEar},
    {"tassel", kEar},
    {"stem", kStem},
    {"stalk", kStem},
    {"petiole", kStem},
    {"branch", kStem},
    {"twig", kStem},
    {"trunk", kStem},
    {"leaf", kLeafReflectance},
    {"leaves", kLeafReflectance},
    {"blade", kLeafReflectance},
    {"pod", kLeafReflectance},
    {"husk", kLeafReflectance},
    {"cotyledon", kLeafReflectance},
    {"flower", kLeafReflectance},
    {"silk", kLeafReflectance},
    {"petal", kLeafReflectance},
}};

// Words of so few letters are part of others ("ear" of "year", "stem" of "system"): they have to
// stand alone. A leaf is not.
constexpr std::size_t kStandsAlone = 4;
constexpr std::string_view kLeaf = "leaf";

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Whether a word of the name begins or ends at the place: "BeanStem2" has the words Bean and Stem.
bool is_border(std::string_view name, std::size_t place) {
  if (place == 0 || place >= name.size()) return true;
  const char before = name[place - 1];
  const char behind = name[place];
  if (!is_letter(before) || !is_letter(behind)) return true;
  return is_upper(behind) && !is_upper(before);
}

bool holds(std::string_view name, std::string_view word) {
  const std::string text = lower_case(name);
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (word.size() > kStandsAlone || word == kLeaf) return true;
    const std::size_t end = at + word.size();
    const bool plural = end < text.size() && text[end] == 's';
    if (is_border(name, at) && (is_border(name, end) || (plural && is_border(name, end + 1))))
      return true;
  }
  return false;
}

}  // namespace

std::optional<float> reflectance_by_name(std::string_view name) {
  for (const Word& word : kWords)
    if (holds(name, word.text)) return word.reflectance;
  return {};
}

bool names_leaf(std::string_view name) {
  return holds(name, kLeaf) || holds(name, "leaves") || holds(name, "blade");
}

std::optional<float> reflectance_of(const Material& material) {
  return material.reflectance ? material.reflectance : reflectance_by_name(material.name);
}

}  // namespace plotscan::mesh
