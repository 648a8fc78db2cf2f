// SPDX-License-Identifier: Apache-2.0
#include "crop/internal/soybean_organs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/angle.h"
#include "crop/internal/axis.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kCotyledon_m = 0.02;
constexpr double kFlower_m = 0.006;
constexpr double kUnifoliolateWidth = 1.25;  // width over length, over that of a leaflet

// The outline of a leaflet: half widths at shares of its length. Ovate: widest before the middle.
constexpr std::array kOutlineShares = {0.0, 0.14, 0.36, 0.6, 0.82, 1.0};
constexpr std::array kOutline = {0.0, 0.76, 1.0, 0.84, 0.46, 0.0};

}  // namespace

void SoybeanOrgans::cotyledons(const Vector3d& node, double azimuth_rad) {
  for (const double azimuth : {azimuth_rad, azimuth_rad + kPi}) {
    const Vector3d along = direction(azimuth, 0.2);
    const Vector3d across = direction(azimuth + kPi / 2, 0);
    const double half = kCotyledon_m / 2;
    plant_.ellipsoid(node + half * along, along, across, {half, 0.5 * half, 0.18 * half},
                     "cotyledon");
  }
}

void SoybeanOrgans::unifoliolate(const SoybeanLeaf& leaf, RandomStream& random) {
  const Vector3d end = petiole(leaf, random);
  leaflet(end, leaf.azimuth_rad, leaf.length_m, kUnifoliolateWidth, leaf.material, random);
}

void SoybeanOrgans::trifoliolate(const SoybeanLeaf& leaf, RandomStream& random) {
  const Vector3d end = petiole(leaf, random);
  const double rachis = traits_["rachis_share"] * leaf.length_m;
  const Vector3d tip = end + rachis * direction(leaf.azimuth_rad, 0.1);
  if (!plant_.light()) stalk({end, tip}, leaf.petiole_radius_m / 2);
  leaflet(tip, leaf.azimuth_rad, leaf.length_m, 1, leaf.material, random);
  const double aside = traits_.radians("lateral_azimuth_deg");
  for (const int side : {-1, 1}) {
    const double azimuth = leaf.azimuth_rad + side * traits_.vary(aside, random);
    leaflet(end, azimuth, leaf.length_m * traits_["lateral_share"], 1, leaf.material, random);
  }
}

// Bends outward along its length; returns its end.
Vector3d SoybeanOrgans::petiole(const SoybeanLeaf& leaf, RandomStream& random) {
  constexpr int kPieces = 3;
  const double bend = traits_.vary(traits_.radians("petiole_bend_deg"), random);
  std::vector<Vector3d> path = {leaf.node};
  for (int i = 0; i < kPieces; ++i) {
    const double share = (i + 0.5) / kPieces - 0.5;
    const double elevation = kPi / 2 - leaf.petiole_angle_rad - share * bend;
    path.push_back(path.back() + leaf.petiole_m / kPieces * direction(leaf.azimuth_rad, elevation));
  }
  stalk(path, leaf.petiole_radius_m);
  return path.back();
}

// In light detail a single triangle.
void SoybeanOrgans::stalk(const std::vector<Vector3d>& path, double radius_m) {
  Tube tube{.path = path,
            .radius_m = std::vector<double>(path.size(), radius_m),
            .sides = 3,
            .light_points = 2,
            .light_sides = 2};
  tube.radius_m.back() = plant_.light() ? 0 : radius_m * 0.7;
  plant_.tube(tube, "stem");
}

// Dips about its mean direction, its tip more than its base, and rolls about its midrib.
void SoybeanOrgans::leaflet(const Vector3d& base, double azimuth_rad, double length_m,
                            double width_factor, const char* material, RandomStream& random) {
  const double tilt = traits_.radians("leaflet_tilt_deg");
  const double dip = traits_.radians("leaflet_droop_deg") + tilt * random.uniform(-1, 1);
  const double bend = traits_.vary(traits_.radians("leaflet_bend_deg"), random);
  const double roll = tilt * random.uniform(-1, 1);
  const double half = length_m * traits_["leaflet_width_ratio"] * width_factor / 2;
  const Vector3d level = direction(azimuth_rad + kPi / 2, 0);
  Blade blade{.midrib = {base},
              .half_width_m = {0},
              .across = {std::cos(roll) * level + std::sin(roll) * Vector3d::UnitZ()},
              .fold_rad = traits_.radians("leaflet_fold_deg"),
              .light_points = 3};
  for (std::size_t i = 1; i < kOutline.size(); ++i) {
    const double middle = (kOutlineShares[i] + kOutlineShares[i - 1]) / 2;
    const double step = kOutlineShares[i] - kOutlineShares[i - 1];
    const Vector3d along = direction(azimuth_rad, -dip - (middle - 0.5) * bend);
    blade.midrib.push_back(blade.midrib.back() + step * length_m * along);
    blade.half_width_m.push_back(kOutline[i] * half);
  }
  plant_.blade(blade, material);
}

void SoybeanOrgans::pods(const Vector3d& axil, double azimuth_rad, double length_m,
                         RandomStream& random) {
  const double drawn = traits_["pods_per_node"] + random.uniform(-1.5, 1.5);
  const int count = std::clamp(static_cast<int>(std::lround(drawn)), 1, 5);
  for (int i = 0; i < count; ++i) {
    const double length = traits_.vary(length_m, random);
    const double azimuth = azimuth_rad + 1.1 * random.uniform(-1, 1);
    const double elevation = random.uniform(-0.9, 0.6);
    if (plant_.light() && i > 0) continue;  // one stands for the cluster
    pod(axil, azimuth, elevation, length);
  }
}

// A flat spindle on a short stalk that curves upward to its tip.
void SoybeanOrgans::pod(const Vector3d& axil, double azimuth_rad, double elevation_rad,
                        double length_m) {
  constexpr double kStalkShare = 0.15;
  constexpr std::array kRadii = {0.0, 0.85, 1.0, 0.0};
  const double widest = length_m * traits_["pod_width_ratio"] / 2;
  Tube tube{.path = {axil + kStalkShare * length_m * direction(azimuth_rad, elevation_rad)},
            .radius_m = {plant_.light() ? widest : 0},
            .sides = 4,
            .across = direction(azimuth_rad, elevation_rad + kPi / 2),
            .flatness = 0.6,
            .light_points = 2,
            .light_sides = 2};
  const double step = length_m / (kRadii.size() - 1);
  for (std::size_t i = 1; i < kRadii.size(); ++i) {
    const double elevation = elevation_rad + 0.25 * (static_cast<double>(i) - 2);
    tube.path.push_back(tube.path.back() + step * direction(azimuth_rad, elevation));
    tube.radius_m.push_back(kRadii[i] * widest);
  }
  plant_.tube(tube, "pod");
}

// Too small to be shown in light detail.
void SoybeanOrgans::flowers(const Vector3d& axil, double azimuth_rad, RandomStream& random) {
  if (plant_.light()) return;
  for (int flower = 0; flower < 3; ++flower) {
    const Vector3d along = direction(azimuth_rad + random.uniform(-1, 1), random.uniform(0, 1.2));
    const Vector3d base = axil + 0.008 * along;
    plant_.tube({.path = {base, base + 0.6 * kFlower_m * along, base + kFlower_m * along},
                 .radius_m = {0, 0.45 * kFlower_m, 0},
                 .sides = 3},
                "flower");
  }
}

}  // namespace plotscan::crop
