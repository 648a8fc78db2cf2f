// SPDX-License-Identifier: Apache-2.0
#include "scan/internal/foreign_file.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "core/contains.h"
#include "scan/internal/cloud_layout.h"

namespace plotscan::scan {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view start;
  std::string_view name;
};

constexpr std::string_view kRaster = "a TIFF picture: heights of a raster are no cloud of returns";
constexpr std::string_view kEsri = "a raster of Esri: heights of a raster are no cloud of returns";
constexpr std::string_view kOff = "an OFF mesh: save its points as PLY or text";
constexpr std::string_view kUtf16 = "UTF-16: save its text as UTF-8";

constexpr std::array kForeign = {
    Kind{"ASTM-E57"sv, "an E57 file: save it as LAS or PLY (CloudCompare reads E57)"sv},
    Kind{"PK\x03\x04"sv, "a zip archive: unpack it"sv},
    Kind{"\x1f\x8b"sv, "a gzip archive: unpack it"sv},
    Kind{"7z\xbc\xaf"sv, "a 7z archive: unpack it"sv},
    Kind{"II*\0"sv, kRaster},
    Kind{"MM\0*"sv, kRaster},
    Kind{"II+\0"sv, kRaster},
    Kind{"\xff\xfe"sv, kUtf16},
    Kind{"\xfe\xff"sv, kUtf16},
    Kind{"<"sv, "a web page or XML: was the download refused?"sv},
    Kind{"version https://git-lfs"sv,
         "a pointer of Git LFS: fetch the file itself (git lfs pull)"sv},
    Kind{"OFF\n"sv, kOff},
    Kind{"OFF\r"sv, kOff},
    Kind{"COFF\n"sv, kOff},
    Kind{"# vtk DataFile"sv, "a VTK file: save its points as PLY or text"sv},
    Kind{"ncols"sv, kEsri},
    Kind{"NCOLS"sv, kEsri},
};

// The words of the first lines that are neither empty nor comments.
std::vector<std::vector<std::string>> first_lines(std::string_view start, std::size_t most) {
  std::istringstream in{std::string(start)};
  std::vector<std::vector<std::string>> lines;
  for (std::string line; lines.size() < most && std::getline(in, line);) {
    std::istringstream words_in(line);
    std::vector<std::string> words;
    for (std::string word; words_in >> word;) words.push_back(word);
    if (!words.empty() && !is_comment(line)) lines.push_back(std::move(words));
  }
  return lines;
}

// Columns, rows, the scanner's place and its three axes, a line each.
bool is_ptx(std::string_view start) {
  const auto lines = first_lines(start, 6);
  constexpr std::array<std::size_t, 6> kWords = {1, 1, 3, 3, 3, 3};
  return std::ranges::equal(lines, kWords, [](const auto& words, std::size_t count) {
    return words.size() == count &&
           std::ranges::all_of(words, [](const auto& word) { return number_of(word).has_value(); });
  });
}

// The first line that names no material and no group is a vertex.
bool is_obj(std::string_view start) {
  constexpr std::size_t kMostLines = 20;
  constexpr std::array kNames = {"mtllib"sv, "usemtl"sv, "o"sv, "g"sv, "s"sv};
  for (const auto& words : first_lines(start, kMostLines)) {
    if (words.size() == 2 && contains(kNames, words[0])) continue;
    return words[0] == "v" && words.size() >= 4 && number_of(words[1]) && number_of(words[2]) &&
           number_of(words[3]);
  }
  return false;
}

}  // namespace

std::string_view foreign_file(std::string_view start) {
  for (const Kind& kind : kForeign)
    if (start.starts_with(kind.start)) return kind.name;
  if (is_ptx(start))
    return "PTX, scans in frames of their own: save it as LAS or PLY (CloudCompare reads PTX)";
  if (is_obj(start)) return "an OBJ mesh: save its points as PLY or text";
  return {};
}

}  // namespace plotscan::scan
