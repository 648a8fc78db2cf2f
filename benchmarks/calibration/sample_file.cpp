// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <fstream>

#include "calibration/field_sample.h"
#include <nlohmann/json.hpp>

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

template <class Value>
std::vector<Value> read_array(std::ifstream& in) {
  std::uint64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  std::vector<Value> values(in ? count : 0);
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(values.size() * sizeof(Value)));
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
  const json header = json::parse(line, nullptr, false);
  if (header.is_discarded()) throw InputError(file.string() + ": is not a sample of a field");
  FieldSample sample{.library = header.at("library"), .seed = header.at("seed")};
  sample.surface = {.origin = pair_of(header["origin"]),
                    .cell_m = header["cell_m"],
                    .columns = header["grid"][0],
                    .rows = header["grid"][1]};
  sample.surface.z_m = read_array<float>(in);
  sample.surface.sd_m = read_array<float>(in);
  sample.surface.seen = read_array<std::uint8_t>(in);
  sample.surface.noise_m = header["noise_m"];
  for (const json& entry : header["plots"]) {
    PlotSample plot{.box = {.center = pair_of(entry["center"]),
                            .width_m = entry["size"][0],
                            .length_m = entry["size"][1],
                            .heading_rad = entry["heading"]},
                    .truth = entry["truth"]};
    plot.points = read_array<Eigen::Vector3f>(in);
    plot.perfect = read_array<Eigen::Vector3f>(in);
    sample.plots.push_back(std::move(plot));
  }
  if (!in) throw InputError(file.string() + ": ends too early");
  return sample;
}

}  // namespace plotscan::calibration
