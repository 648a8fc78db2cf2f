// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <fstream>

#include <nlohmann/json.hpp>

#include "calibration/field_sample.h"
#include "core/error.h"

namespace plotscan::calibration {
namespace {

using nlohmann::json;

// A line of JSON, then the arrays as they lie in memory. No exchange format: written and read by
// this program on one machine.
template <class Value>
void write_array(std::ofstream& out, const std::vector<Value>& values) {
  const std::uint64_t count = values.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(count * sizeof(Value)));
}

std::uint64_t bytes_left(std::ifstream& in) {
  const std::streamoff here = in.tellg();
  in.seekg(0, std::ios::end);
  const std::streamoff end = in.tellg();
  in.seekg(here);
  return static_cast<std::uint64_t>(end - here);
}

template <class Value>
std::vector<Value> read_array(std::ifstream& in, const std::filesystem::path& file) {
  std::uint64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  if (!in || count > bytes_left(in) / sizeof(Value)) throw InputError(file, "ends too early");
  std::vector<Value> values(count);
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(count * sizeof(Value)));
  return values;
}

Eigen::Vector2d pair_of(const json& pair) {
  return {pair.at(0).get<double>(), pair.at(1).get<double>()};
}

json json_of(const FieldSample& sample) {
  const ground::Surface& surface = sample.surface;
  json plots = json::array();
  for (const PlotSample& plot : sample.plots) {
    plots.push_back({{"center", {plot.box.center.x(), plot.box.center.y()}},
                     {"size", {plot.box.width_m, plot.box.length_m}},
                     {"heading", plot.box.heading_rad},
                     {"truth", plot.truth}});
  }
  return {{"library", sample.library},
          {"seed", sample.seed},
          {"origin", {surface.origin.x(), surface.origin.y()}},
          {"cell_m", surface.cell_m},
          {"grid", {surface.columns, surface.rows}},
          {"noise_m", surface.noise_m},
          {"plots", plots}};
}

FieldSample sample_of(const json& header) {
  FieldSample sample{.library = header.at("library"), .seed = header.at("seed")};
  sample.surface = {{.origin = pair_of(header.at("origin")),
                     .cell_m = header.at("cell_m"),
                     .columns = header.at("grid").at(0),
                     .rows = header.at("grid").at(1)}};
  sample.surface.noise_m = header.at("noise_m");
  for (const json& plot : header.at("plots")) {
    sample.plots.push_back({.box = {.center = pair_of(plot.at("center")),
                                    .width_m = plot.at("size").at(0),
                                    .length_m = plot.at("size").at(1),
                                    .heading_rad = plot.at("heading")},
                            .truth = plot.at("truth")});
  }
  return sample;
}

// All but the arrays.
FieldSample described_by(const std::string& line, const std::filesystem::path& file) {
  try {
    return sample_of(json::parse(line));
  } catch (const json::exception&) {
    throw InputError(file, "is not a sample of a field");
  }
}

}  // namespace

void write_sample(const std::filesystem::path& file, const FieldSample& sample) {
  std::ofstream out(file, std::ios::binary);
  out << json_of(sample).dump() << '\n';
  write_array(out, sample.surface.z_m);
  write_array(out, sample.surface.sd_m);
  write_array(out, sample.surface.seen);
  for (const PlotSample& plot : sample.plots) {
    write_array(out, plot.points);
    write_array(out, plot.perfect);
  }
  if (!out.flush()) throw WriteError(file);
}

FieldSample read_sample(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  std::getline(in, line);
  FieldSample sample = described_by(line, file);
  sample.surface.z_m = read_array<float>(in, file);
  sample.surface.sd_m = read_array<float>(in, file);
  sample.surface.seen = read_array<std::uint8_t>(in, file);
  for (PlotSample& plot : sample.plots) {
    plot.points = read_array<Eigen::Vector3f>(in, file);
    plot.perfect = read_array<Eigen::Vector3f>(in, file);
  }
  return sample;
}

}  // namespace plotscan::calibration
