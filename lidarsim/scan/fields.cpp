// SPDX-License-Identifier: Apache-2.0
#include "scan/fields.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "core/error.h"

namespace plotscan::scan {
namespace {

// The bytes of a number as an unsigned integer of its size.
template <class Bits>
Bits load(const char* bytes, bool swap) {
  Bits bits;
  std::memcpy(&bits, bytes, sizeof bits);
  if (!swap || sizeof bits == 1) return bits;
  if constexpr (sizeof bits == 2) return __builtin_bswap16(bits);
  if constexpr (sizeof bits == 4) return __builtin_bswap32(bits);
  if constexpr (sizeof bits == 8) return __builtin_bswap64(bits);
  return bits;
}

template <class Bits>
double integer(char kind, Bits bits) {
  return kind == 'I' ? static_cast<double>(static_cast<std::make_signed_t<Bits>>(bits))
                     : static_cast<double>(bits);
}

double number(const ScalarField& field, const char* bytes, bool swap) {
  switch (field.size) {
    case 1:
      return integer(field.kind, load<std::uint8_t>(bytes, swap));
    case 2:
      return integer(field.kind, load<std::uint16_t>(bytes, swap));
    case 4: {
      const auto bits = load<std::uint32_t>(bytes, swap);
      return field.kind == 'F' ? std::bit_cast<float>(bits) : integer(field.kind, bits);
    }
    default: {
      const auto bits = load<std::uint64_t>(bytes, swap);
      return field.kind == 'F' ? std::bit_cast<double>(bits) : integer(field.kind, bits);
    }
  }
}

template <class Whole>
bool assign_whole(Whole& field, double value) {
  const double rounded = std::round(value);
  if (!(rounded >= 0 && rounded <= std::numeric_limits<Whole>::max())) return false;
  field = static_cast<Whole>(rounded);
  return true;
}

PointClass class_of(double number) {
  if (number == 0) return PointClass::unlabelled;
  if (number == 1) return PointClass::ground;
  if (number == 2) return PointClass::crop;
  if (number == 3) return PointClass::weed;
  return PointClass::other;
}

}  // namespace

double decode(const ScalarField& field, const char* bytes, bool swap) {
  double value = number(field, bytes, swap);
  if (field.bits > 0)
    value = (static_cast<unsigned>(value) >> field.shift) & ((1u << field.bits) - 1);
  const bool scaled = field.scale != 1 || field.add != 0;
  return scaled ? value * field.scale + field.add : value;
}

double time_unit_s(const ScalarField& time) { return time.kind == 'F' ? 1 : 1e-9; }

std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name)
    if (c != '_') plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::string_view kPrefix = "scalar";
  return plain.starts_with(kPrefix) ? plain.substr(kPrefix.size()) : plain;
}

const std::vector<KnownField>& known_fields() {
  static const std::vector<KnownField> fields = {
      {"intensity",
       {"intensity", "reflectivity"},
       [](LabelledPoint& p, double v) {
         p.intensity = static_cast<float>(v);
         return std::isfinite(p.intensity);
       }},
      {"ring",
       {"ring", "laserid", "channel"},
       [](LabelledPoint& p, double v) { return assign_whole(p.ring, v); }},
      {"time",
       {"time", "timestamp", "gpstime", "t"},
       [](LabelledPoint& p, double v) {
         p.time = v;
         return std::isfinite(v);
       }},
      {"return_number",
       {"returnnumber"},
       [](LabelledPoint& p, double v) { return assign_whole(p.return_number, v); }},
      {"return_count",
       {"returncount", "numberofreturns"},
       [](LabelledPoint& p, double v) { return assign_whole(p.return_count, v); }},
      {"class",
       {"class", "label"},
       [](LabelledPoint& p, double v) {
         p.label = class_of(v);
         return true;
       }},
      {"plot", {"plot"}, [](LabelledPoint& p, double v) { return assign_whole(p.plot, v); }},
      {"plant", {"plant"}, [](LabelledPoint& p, double v) { return assign_whole(p.plant, v); }},
  };
  return fields;
}

const KnownField& known_field(const std::string& name) {
  const auto found = std::ranges::find(known_fields(), name, &KnownField::name);
  check(found != known_fields().end(), "there is a field " + name);
  return *found;
}

}  // namespace plotscan::scan
