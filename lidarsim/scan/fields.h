// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scan/point.h"

// What files call a point's fields, where their numbers lie, and which ones a LabelledPoint has.
namespace plotscan::scan {

// Where one number of a point lies, and how it is read: value = number * scale + add.
struct ScalarField {
  std::string name;
  char kind = 'F';         // I: signed, U: unsigned, F: float
  std::size_t size = 4;    // of one element, bytes: 1, 2, 4 or 8; a float has 4 or 8
  std::size_t count = 1;   // elements
  std::size_t column = 0;  // of an ascii line
  std::size_t offset = 0;  // in a binary record, bytes
  // LAS packs several numbers in a byte: this one has `bits` bits from bit `shift` on; 0: all.
  int shift = 0;
  int bits = 0;
  double scale = 1;
  double add = 0;
};

// The value of the field whose number lies at `bytes`; `swap`: in the other byte order.
double decode(const ScalarField& field, const char* bytes, bool swap);

// The unit of a field of times in seconds: ROS drivers write seconds (floats) or whole numbers of
// nanoseconds.
double time_unit_s(const ScalarField& time);

// A field's name in lower case, without underscores and CloudCompare's "scalar_": "ReturnNumber"
// and "scalar_return_number" are "returnnumber".
std::string plain_name(const std::string& name);

// A field of LabelledPoint besides x, y and z.
struct KnownField {
  std::string name;  // in Plotscan's PCD and PLY files
  // By which programs and drivers call it, the most usual first (docs/formats.md).
  std::vector<std::string> plain_names;
  // Puts a number into a point; false when it does not fit.
  bool (*put)(LabelledPoint& point, double number);
};

const std::vector<KnownField>& known_fields();
// The one of that name, which must exist.
const KnownField& known_field(const std::string& name);

}  // namespace plotscan::scan
