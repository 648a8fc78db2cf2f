// SPDX-License-Identifier: Apache-2.0
// ground_at_points ESTIMATE CLOUD [CLASS]: the error of an estimate's ground at the points of a
// cloud, or those of an ASPRS class of it, as JSON (scripts/measure_clouds). Points and errors in
// metres; `inside` is the share of points within 1.96 standard errors, of those that have a ground.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/cloud_files.h"
#include "core/error.h"
#include "core/parse.h"
#include "estimate/ground_grids.h"
#include "scan/cloud_reader.h"

namespace {

using namespace plotscan;

struct Errors {
  double points = 0, known = 0, inside = 0, sum_m = 0, squares_m2 = 0;

  void add(const ground::Surface& surface, const Eigen::Vector3d& point) {
    ++points;
    const double off_m = surface.height(point.head<2>()) - point.z();
    if (std::isnan(off_m)) return;
    ++known;
    sum_m += off_m;
    squares_m2 += off_m * off_m;
    inside += std::abs(off_m) < 1.96 * surface.standard_error(point.head<2>());
  }
};

CloudFiles reference(const std::filesystem::path& file, const char* only_class) {
  CloudFiles cloud(file);
  if (only_class == nullptr) return cloud;
  const std::optional<int> number = parsed<int>(only_class);
  if (!number || *number < 0 || *number > 255)
    throw InputError(std::string("CLASS ") + only_class + " is no number of 0 to 255");
  cloud.only_classes = {*number};
  return cloud;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: ground_at_points ESTIMATE CLOUD [CLASS]\n";
    return 2;
  }
  try {
    const CloudFiles cloud = reference(argv[2], argc > 3 ? argv[3] : nullptr);
    const ground::Surface surface =
        estimate::read_ground(argv[1], scan::read_cloud_system(cloud).units);
    Errors errors;
    scan::read_positions(cloud, [&](auto points) {
      for (const Eigen::Vector3d& point : points) errors.add(surface, point);
    });
    std::cout << nlohmann::json{{"points", errors.points},
                                {"without", errors.points - errors.known},
                                {"mean_m", errors.sum_m / errors.known},
                                {"rms_m", std::sqrt(errors.squares_m2 / errors.known)},
                                {"inside", errors.inside / errors.known}}
              << '\n';
  } catch (const InputError& error) {
    std::cerr << "ground_at_points: " << error.what() << '\n';
    return 2;
  }
}
