// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the readers of a cloud's body share.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {

// Which points and fields are wanted, and the sink for them.
struct Wanted {
  std::uint64_t points;
  std::span<const ScalarField> fields;
  const RowSink& sink;
};

// Collects rows and passes them on in chunks.
class Rows {
 public:
  explicit Rows(const Wanted& wanted) : wanted_(wanted) {
    numbers_.reserve(kChunkPoints * wanted.fields.size());
  }

  void add(double number) { numbers_.push_back(number); }
  void end_row() {
    if (numbers_.size() == kChunkPoints * wanted_.fields.size()) flush();
  }
  void flush() {
    if (!numbers_.empty()) wanted_.sink(numbers_);
    numbers_.clear();
  }

 private:
  static constexpr std::size_t kChunkPoints = 8192;

  const Wanted& wanted_;
  std::vector<double> numbers_;
};

// Reads one point a line, from the current position of `in`.
void read_ascii(const std::filesystem::path& file, std::ifstream& in, const CloudLayout& layout,
                const Wanted& wanted);

#ifdef PLOTSCAN_HAVE_LASZIP
// Reads LAZ and COPC through LASzip, which opens the file itself.
void read_laz(const std::filesystem::path& file, const CloudLayout& layout, const Wanted& wanted);
#endif

}  // namespace plotscan::scan
