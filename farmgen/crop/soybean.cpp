// SPDX-License-Identifier: Apache-2.0
#include "crop/soybean.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/random.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kGrid_m = 1e-5;  // coordinates are multiples of it
constexpr int kStemSides = 4;
constexpr int kPetioleSides = 3;
constexpr int kLeafletStations = 4;           // rows of triangles along a leaflet
constexpr double kPetioleRadiusShare = 0.35;  // of the stem's at its foot
constexpr double kLeafletStartElevation_deg = 20;
constexpr double kLateralAzimuth_deg = 75;
constexpr double kStalkShare = 0.3;     // the terminal leaflet's stalk over a leaflet's length
constexpr double kBranchVigour = 0.85;  // lengths on a branch over those on the main stem
constexpr double kBranchUpturn = 0.15;  // share by which a branch turns upright at each node

Vector3d direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// Linear between (0, first), (bend, 1) and (1, last).
double profile(double share, double first, double bend, double last) {
  return share < bend ? first + (1 - first) * share / bend
                      : 1 + (last - 1) * (share - bend) / (1 - bend);
}

class SoybeanBuilder {
 public:
  SoybeanBuilder(const SoybeanOptions& options, std::uint64_t seed)
      : options_(options), seed_(seed) {}

  mesh::Mesh build() {
    RandomStream random(seed_, random_purpose("soybean/stem"), 0);
    const double lean = options_.lean_deg * kRadians * random.uniform();
    const double azimuth = 2 * std::numbers::pi * random.uniform();
    first_azimuth_ = 2 * std::numbers::pi * random.uniform();
    const auto nodes = static_cast<int>(options_.nodes);
    const std::vector<Vector3d> stem =
        grow_axis({.axis = 0,
                   .nodes = nodes,
                   .first_leaf = static_cast<int>(options_.first_leaf_node),
                   .foot = Vector3d::Zero(),
                   .heading = direction(azimuth, std::numbers::pi / 2 - lean),
                   .vigour = 1,
                   .upturn = 0});
    const int branches = std::min(static_cast<int>(options_.branches), nodes - 1);
    for (int branch = 1; branch <= branches; ++branch) grow_branch(branch, stem[branch + 1]);
    return std::move(mesh_);
  }

 private:
  struct Axis {
    int axis;  // 0 for the main stem, then the branches
    int nodes;
    int first_leaf;  // node, from 1
    Vector3d foot;
    Vector3d heading;
    double vigour;
    double upturn;
  };

  // Grows internode by internode, a leaf at each node; returns the foot and the nodes.
  std::vector<Vector3d> grow_axis(const Axis& axis) {
    std::vector<Vector3d> path = {axis.foot};
    Vector3d heading = axis.heading;
    for (int node = 1; node <= axis.nodes; ++node) {
      RandomStream random(seed_, random_purpose("soybean/node"), 100 * axis.axis + node);
      const double share = static_cast<double>(node) / axis.nodes;
      const double length =
          vary(options_.internode_m, random) * axis.vigour * profile(share, 0.6, 0.6, 0.5);
      path.push_back(path.back() + length * heading);
      const double azimuth = first_azimuth_ + axis.axis * 2.0 +
                             node * options_.phyllotaxis_deg * kRadians +
                             options_.variation * random.uniform(-1, 1);
      if (node >= axis.first_leaf) grow_leaf(path.back(), azimuth, share, axis.vigour, random);
      // The stem leans away from each leaf in turn.
      const double zigzag = vary(options_.zigzag_deg, random) * kRadians;
      const Vector3d turned = axis.heading - std::sin(zigzag) * direction(azimuth, 0);
      const double upright = std::min(1.0, axis.upturn * node);
      heading = ((1 - upright) * turned.normalized() + upright * Vector3d::UnitZ()).normalized();
    }
    const double foot_radius = options_.stem_radius_m * axis.vigour;
    add_tube(path, foot_radius, foot_radius / 4, kStemSides);
    return path;
  }

  void grow_branch(int branch, const Vector3d& foot) {
    RandomStream random(seed_, random_purpose("soybean/branch"), branch);
    const double azimuth = first_azimuth_ + (branch + 1) * options_.phyllotaxis_deg * kRadians +
                           random.uniform(-0.3, 0.3);
    const double angle = vary(options_.branch_angle_deg, random) * kRadians;
    grow_axis({.axis = branch,
               .nodes = static_cast<int>(options_.branch_nodes),
               .first_leaf = 1,
               .foot = foot,
               .heading = direction(azimuth, std::numbers::pi / 2 - angle),
               .vigour = kBranchVigour,
               .upturn = kBranchUpturn});
  }

  // A petiole with three leaflets; `share` is the node's place along its axis, in (0, 1].
  void grow_leaf(const Vector3d& node, double azimuth, double share, double vigour,
                 RandomStream& random) {
    const double petiole =
        vary(options_.petiole_m, random) * vigour * profile(share, 0.7, 0.6, 0.4);
    const double angle = vary(options_.petiole_angle_deg, random) * profile(share, 1, 0.5, 0.8);
    const double size =
        vary(options_.leaflet_length_m, random) * vigour * profile(share, 0.75, 0.5, 0.65);
    const Vector3d end = node + petiole * direction(azimuth, (90 - angle) * kRadians);
    const double radius = options_.stem_radius_m * kPetioleRadiusShare;
    add_tube({node, end}, radius, radius / 2, kPetioleSides);
    for (const int side : {-1, 0, 1}) {
      const double heading = azimuth + side * vary(kLateralAzimuth_deg, random) * kRadians;
      const Vector3d base = side == 0 ? end + kStalkShare * size * direction(azimuth, 0) : end;
      add_leaflet(base, heading, size, random);
    }
  }

  // A sheet about a midrib that droops towards its tip: a row of three vertices at each station.
  void add_leaflet(const Vector3d& base, double azimuth, double length, RandomStream& random) {
    const double width = length * options_.leaflet_width_ratio;
    const double elevation = kLeafletStartElevation_deg * kRadians + 0.5 * random.uniform(-1, 1);
    const double bend = vary(options_.leaflet_bend_deg, random) * kRadians;
    const double roll = 0.35 * random.uniform(-1, 1);
    const double fold = options_.leaflet_fold_deg * kRadians;
    const Vector3d across = direction(azimuth + std::numbers::pi / 2, 0);
    Vector3d midrib = base;
    std::uint32_t last = add_vertex(base);
    for (int station = 1; station <= kLeafletStations; ++station) {
      const double share = static_cast<double>(station) / kLeafletStations;
      const Vector3d along = direction(azimuth, elevation - bend * share);
      midrib += along * (length / kLeafletStations);
      if (station == kLeafletStations) {
        const std::uint32_t tip = add_vertex(midrib);
        mesh_.triangles.push_back({last, tip, last + 1});
        mesh_.triangles.push_back({last, last + 2, tip});
        return;
      }
      // Ovate: widest before the middle.
      const double half = width / 2 * std::sin(std::numbers::pi * std::pow(share, 0.75));
      const Vector3d normal = along.cross(across);
      const auto edge = [&](double side) -> Vector3d {
        return midrib + side * half * (std::cos(roll) * std::cos(fold) * across) +
               half * (std::sin(fold) + side * std::sin(roll)) * normal;
      };
      const std::uint32_t row = add_vertex(midrib);
      add_vertex(edge(1));
      add_vertex(edge(-1));
      join_rows(last, row, station == 1);
      last = row;
    }
  }

  // Rows are (midrib, left, right); the first row is the base's single vertex.
  void join_rows(std::uint32_t last, std::uint32_t row, bool first) {
    mesh_.triangles.push_back({last, row, row + 1});
    mesh_.triangles.push_back({last, row + 2, row});
    if (first) return;
    mesh_.triangles.push_back({last, row + 1, last + 1});
    mesh_.triangles.push_back({last, last + 2, row + 2});
  }

  // An open tube along the path, its radius tapering from the first point to the last.
  void add_tube(const std::vector<Vector3d>& path, double first_radius, double last_radius,
                int sides) {
    std::uint32_t last_ring = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(path.size() - 1);
      const double radius = first_radius + share * (last_radius - first_radius);
      const auto ring = static_cast<std::uint32_t>(mesh_.vertices.size());
      for (int side = 0; side < sides; ++side) {
        add_vertex(path[i] + radius * direction(2 * std::numbers::pi * side / sides, 0));
      }
      for (int side = 0; i > 0 && side < sides; ++side) {
        const auto a = static_cast<std::uint32_t>(side);
        const auto b = static_cast<std::uint32_t>((side + 1) % sides);
        mesh_.triangles.push_back({last_ring + a, last_ring + b, ring + b});
        mesh_.triangles.push_back({last_ring + a, ring + b, ring + a});
      }
      last_ring = ring;
    }
  }

  std::uint32_t add_vertex(const Vector3d& point) {
    const Vector3d whole = (point / kGrid_m).array().round();
    mesh_.vertices.emplace_back((whole * kGrid_m).cast<float>());
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  double vary(double value, RandomStream& random) const {
    return value * (1 + options_.variation * random.uniform(-1, 1));
  }

  const SoybeanOptions& options_;
  std::uint64_t seed_;
  double first_azimuth_ = 0;
  mesh::Mesh mesh_;
};

}  // namespace

mesh::Mesh soybean(const SoybeanOptions& options, std::uint64_t seed) {
  return SoybeanBuilder(options, seed).build();
}

}  // namespace plotscan::crop
