// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angle.h"
#include "core/random.h"
#include "crop/internal/axis.h"
#include "crop/internal/form.h"
#include "crop/internal/soybean_organs.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr int kMainStem = 0;                  // the shoot's number; branches follow from 1
constexpr double kPetioleRadiusShare = 0.28;  // of the stem's at its foot
constexpr double kFullStemNodes = 13;         // a stem of fewer is thinner
constexpr double kBranchUpturn = 0.3;         // share by which a branch turns upright at each node
constexpr double kLeavesToLow = 8;            // from the highest leaf to the lowest petiole angle

// The points of a shoot: where it stands, and each node.
struct Shoot {
  int number = kMainStem;
  int nodes = 0;             // with full-grown leaves
  double first_azimuth = 0;  // of the first alternate leaf
  double vigour = 1;         // lengths over those of a mean main stem
  Vector3d foot = Vector3d::Zero();
  Vector3d heading = Vector3d::UnitZ();
};

class Soybean {
 public:
  Soybean(const Traits& traits, std::uint64_t seed, PlantBuilder& plant)
      : traits_(traits), seed_(seed), plant_(plant), organs_(traits, plant) {}

  void grow() {
    RandomStream random(seed_, random_purpose("soybean/stem"), 0);
    const double lean = traits_.radians("lean_deg") * random.uniform();
    const double lean_azimuth = 2 * kPi * random.uniform();
    const int spread = traits_.count("nodes_variation");
    const int more = static_cast<int>(random.below(2 * static_cast<std::uint64_t>(spread) + 1));
    const Shoot stem{.number = kMainStem,
                     .nodes = std::max(1, traits_.count("nodes") + more - spread),
                     .first_azimuth = 2 * kPi * random.uniform(),
                     .vigour = 1 + traits_["plant_variation"] * random.uniform(-1, 1),
                     .foot = Vector3d::Zero(),
                     .heading = direction(lean_azimuth, kPi / 2 - lean)};
    const std::vector<Vector3d> path = grow_axis(stem);
    const int branches = std::min(traits_.count("branches"), stem.nodes - 1);
    for (int branch = 1; branch <= branches; ++branch) grow_branch(stem, branch, path);
  }

 private:
  // Grows internode by internode; returns the foot, on the main stem the cotyledons' node, and the
  // nodes from 1.
  std::vector<Vector3d> grow_axis(const Shoot& shoot) {
    const bool main = shoot.number == kMainStem;
    std::vector<Vector3d> path = {shoot.foot};
    Vector3d heading = shoot.heading;
    if (main) {
      path.push_back(path.back() + traits_["hypocotyl_m"] * shoot.vigour * heading);
      if (traits_.count("cotyledons") == 1) organs_.cotyledons(path.back(), shoot.first_azimuth);
    }
    const int last = shoot.nodes + traits_.count("unfolding_leaves");
    for (int node = 1; node <= last; ++node) {
      RandomStream random(seed_, random_purpose("soybean/node"),
                          static_cast<std::uint64_t>(1000 * shoot.number + node));
      path.push_back(path.back() + internode_m(shoot, node, random) * heading);
      const double azimuth = leaf_azimuth(shoot, node, random);
      grow_node(shoot, node, path.back(), azimuth, random);
      // The stem leans away from each leaf in turn.
      const double zigzag = traits_.vary(traits_.radians("zigzag_deg"), random);
      const Vector3d turned = shoot.heading - std::sin(zigzag) * direction(azimuth, 0);
      const double upright = main ? 0 : std::min(1.0, kBranchUpturn * node);
      heading = ((1 - upright) * turned.normalized() + upright * Vector3d::UnitZ()).normalized();
    }
    add_stem(shoot, path);
    return path;
  }

  void grow_branch(const Shoot& stem, int branch, const std::vector<Vector3d>& path) {
    RandomStream random(seed_, random_purpose("soybean/branch"),
                        static_cast<std::uint64_t>(branch));
    const int node = branch + 1;  // the axils of the lowest trifoliolate leaves
    RandomStream leaf(seed_, random_purpose("soybean/node"), static_cast<std::uint64_t>(node));
    traits_.vary(1, leaf);  // the internode's, so that the azimuth is that of the leaf
    const double azimuth = leaf_azimuth(stem, node, leaf) + 0.3 * random.uniform(-1, 1);
    const double angle = traits_.vary(traits_.radians("branch_angle_deg"), random);
    grow_axis({.number = branch,
               .nodes = std::max(1, traits_.count("branch_nodes") + 1 - branch),
               .first_azimuth = azimuth + kPi / 2,
               .vigour = stem.vigour * traits_["branch_vigour"],
               .foot = path[static_cast<std::size_t>(node) + 1],
               .heading = direction(azimuth, kPi / 2 - angle)});
  }

  // A node's place in the profiles of size: a branch begins among the middle nodes.
  double profile(const Shoot& shoot, int node, const char* low_share) const {
    const double peak = traits_["peak_node"];
    const double last = std::max(traits_["last_node"], peak + 1);
    const double place = shoot.number == kMainStem ? node : peak - 2 + node;
    if (place <= peak) {
      const double rise = std::clamp((place - 2) / (peak - 2), 0.0, 1.0);
      return traits_[low_share] + (1 - traits_[low_share]) * rise;
    }
    return 1 - (1 - traits_["last_share"]) * std::min(1.0, (place - peak) / (last - peak));
  }

  // Share of its full length that an organ has, this many nodes above the highest full-grown one.
  double unfolding(const char* young_share, int nodes_above) const {
    return std::pow(traits_[young_share], std::max(0, nodes_above));
  }

  double internode_m(const Shoot& shoot, int node, RandomStream& random) const {
    const bool epicotyl = shoot.number == kMainStem && node == 1;
    const double grown = epicotyl ? traits_["epicotyl_m"]
                                  : traits_["internode_m"] *
                                        profile(shoot, node, "internode_low_share") *
                                        unfolding("internode_young_share", node - shoot.nodes + 2);
    return traits_.vary(grown, random) * shoot.vigour;
  }

  // Node 1 of the main stem stands across the first trifoliolate leaf.
  double leaf_azimuth(const Shoot& shoot, int node, RandomStream& random) const {
    const double scatter = traits_.radians("azimuth_scatter_deg") * random.uniform(-1, 1);
    if (shoot.number == kMainStem && node == 1) return shoot.first_azimuth + kPi / 2 + scatter / 4;
    return shoot.first_azimuth + node * traits_.radians("phyllotaxis_deg") + scatter;
  }

  // What a node bears: leaves, or their scars, flowers, pods.
  void grow_node(const Shoot& shoot, int node, const Vector3d& point, double azimuth,
                 RandomStream& random) {
    const bool main = shoot.number == kMainStem;
    // A branch's first leaf unfolds three nodes after the leaf of its axil.
    const int age_node = main ? node : shoot.number + 1 + 3 + node;
    const int shed = traits_.count("shed_nodes");
    const bool old = age_node <= shed + traits_.count("old_leaves");
    if (age_node > shed) {
      const char* const material = old ? "old_leaf" : "leaf";
      if (main && node == 1) {
        grow_unifoliolate(shoot, point, azimuth, material, random);
        grow_unifoliolate(shoot, point, azimuth + kPi, material, random);
      } else {
        grow_leaf(shoot, node, point, azimuth, material, random);
      }
    }
    if (node >= shoot.nodes || (main && node < traits_.count("pod_first_node"))) return;
    RandomStream cluster(seed_, random_purpose("soybean/cluster"),
                         static_cast<std::uint64_t>(1000 * shoot.number + node));
    if (traits_["pods_per_node"] > 0) {
      const double age = std::min(1.0, (shoot.nodes - node + 1) / 4.0);  // the higher the younger
      const double length = traits_["pod_length_m"] * (0.4 + 0.6 * age) * shoot.vigour;
      organs_.pods(point, azimuth, length, cluster);
    }
    if (shoot.nodes - node <= traits_.count("flower_nodes"))
      organs_.flowers(point, azimuth, cluster);
  }

  // One of the two simple leaves of node 1.
  void grow_unifoliolate(const Shoot& shoot, const Vector3d& point, double azimuth,
                         const char* material, RandomStream& random) {
    const double length = traits_.vary(traits_["unifoliolate_m"], random) * shoot.vigour;
    organs_.unifoliolate({.node = point,
                          .azimuth_rad = azimuth,
                          .length_m = length,
                          .petiole_m = 0.45 * length,
                          .petiole_angle_rad = traits_.radians("petiole_low_angle_deg"),
                          .petiole_radius_m = petiole_radius_m(shoot),
                          .material = material},
                         random);
  }

  void grow_leaf(const Shoot& shoot, int node, const Vector3d& point, double azimuth,
                 const char* material, RandomStream& random) {
    const double size = traits_.vary(traits_["leaflet_length_m"], random) * shoot.vigour *
                        profile(shoot, node, "leaflet_low_share") *
                        unfolding("leaf_young_share", node - shoot.nodes);
    // Petioles and internodes are still lengthening when the leaf is full grown.
    const double petiole = traits_.vary(traits_["petiole_m"], random) * shoot.vigour *
                           profile(shoot, node, "petiole_low_share") *
                           unfolding("petiole_young_share", node - shoot.nodes + 1);
    const int highest = shoot.nodes + traits_.count("unfolding_leaves");
    const double lowness = std::min(1.0, (highest - node) / kLeavesToLow);
    const double top = traits_.radians("petiole_top_angle_deg");
    const double low = traits_.radians("petiole_low_angle_deg");
    const double angle = traits_.vary(top + (low - top) * lowness, random);
    organs_.trifoliolate({.node = point,
                          .azimuth_rad = azimuth,
                          .length_m = size,
                          .petiole_m = petiole,
                          .petiole_angle_rad = angle,
                          .petiole_radius_m = petiole_radius_m(shoot),
                          .material = material},
                         random);
  }

  double stem_radius_m(const Shoot& shoot) const {
    const double nodes = traits_["nodes"];
    return traits_["stem_radius_m"] * shoot.vigour *
           std::sqrt(std::min(1.0, nodes / kFullStemNodes));
  }

  double petiole_radius_m(const Shoot& shoot) const {
    return stem_radius_m(shoot) * kPetioleRadiusShare;
  }

  void add_stem(const Shoot& shoot, const std::vector<Vector3d>& path) {
    Tube stem{.path = path,
              .radius_m = {},
              .sides = 6,
              .closed_tip = true,
              .light_points = shoot.number == kMainStem ? 4 : 2,
              .light_sides = 3};
    const double foot = stem_radius_m(shoot);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(path.size() - 1);
      stem.radius_m.push_back(foot * (1 - 0.75 * share));
    }
    plant_.tube(stem, "stem");
  }

  const Traits& traits_;
  std::uint64_t seed_;
  PlantBuilder& plant_;
  SoybeanOrgans organs_;
};

}  // namespace

void grow_soybean(const Traits& traits, std::uint64_t seed, PlantBuilder& plant) {
  Soybean(traits, seed, plant).grow();
}

}  // namespace plotscan::crop
