// SPDX-License-Identifier: Apache-2.0
#include "strata/kept_field.h"

#include <fstream>

#include "core/error.h"
#include "core/json_text.h"
#include "core/random.h"
#include "core/temporary_path.h"
#include "core/text_file.h"
#include "lidar/fly.h"
#include "lidar/make_farm.h"
#include "scan/cloud_reader.h"
#include "strata/empty_field.h"
#include "strata/thinned_cloud.h"

namespace plotscan::strata {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

// Written last: a folder that has it is whole.
constexpr const char* kPlan = "plan.json";

// Whether the folder holds the field of that plan already.
bool holds(const fs::path& folder, const json& plan) {
  std::ifstream in(folder / kPlan);
  if (!in) return false;
  if (json::parse(in, nullptr, false) == plan) return true;
  throw InputError(folder,
                   "holds a field of another word or version; keep fields in another folder");
}

// Cuts a cloud to a rectangle, and so far around it.
void cut(std::vector<Eigen::Vector3f>& points, PlotBox rectangle, double margin_m) {
  rectangle.width_m += 2 * margin_m;
  rectangle.length_m += 2 * margin_m;
  std::erase_if(points, [&](const Eigen::Vector3f& point) {
    return !rectangle.contains(point.head<2>().cast<double>());
  });
}

void make_farm(const FieldPlan& plan, const KeptField& field, int threads) {
  const farm::Farm farm = lidar::make_farm(plan.farm, field.farm,
                                           {.overrides = plan.overrides,
                                            .seed = plan.seed,
                                            .threads = threads,
                                            .replace = true,
                                            .command = "measure_plots run"});
  lidar::FlyOptions flight = plan.flight;
  flight.threads = threads;
  flight.replace = true;
  const TemporaryPath scan(field.cloud.parent_path() / ".scan");
  lidar::fly(farm, scan.path(), flight);
  std::vector<Eigen::Vector3f> points = scan::read_positions(scan.path() / "cloud.pcd");
  if (plan.most_points) thin(points, *plan.most_points, plan.seed);
  RandomStream random(plan.seed, random_purpose("strata/beside"), 0);
  lift(points, draw_beside(plan.beside, farm.plots, random), random);
  if (plan.margin_m) cut(points, rectangle_about(farm.plots), *plan.margin_m);
  write_positions(field.cloud, points);
}

}  // namespace

KeptField keep_farm(const FieldPlan& plan, const fs::path& folder, int threads) {
  KeptField field{.cloud = folder / "scan" / "cloud.pcd", .farm = folder / "farm"};
  if (holds(folder, to_json(plan))) return field;
  fs::create_directories(field.cloud.parent_path());
  make_farm(plan, field, threads);
  write_text_file(folder / kPlan, json_lines(to_json(plan)));
  return field;
}

KeptField keep_empty_field(const std::string& word, const std::string& kind, int index,
                           const fs::path& folder) {
  KeptField field{.cloud = folder / "scan" / "cloud.pcd", .farm = {}};
  RandomStream random = field_stream(word, kind, index);
  const json plan = {
      {"kind", kind}, {"index", index}, {"seed", field_stream(word, kind, index).next_u32()}};
  if (holds(folder, plan)) return field;
  fs::create_directories(field.cloud.parent_path());
  write_positions(field.cloud, draw_empty_field(kind, random));
  write_text_file(folder / kPlan, json_lines(plan));
  return field;
}

}  // namespace plotscan::strata
