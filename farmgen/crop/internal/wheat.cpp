// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "core/angle.h"
#include "core/random.h"
#include "crop/internal/axis.h"
#include "crop/internal/form.h"
#include "crop/internal/grass.h"
#include "crop/internal/wheat_ear.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

// Of a grown stem: its elongated internodes from the base, the last one the peduncle under the ear.
// Each is longer than the one below (Kirby 2002, The stem).
constexpr std::array<double, 5> kInternodeShares = {0.07, 0.12, 0.17, 0.23, 0.41};
constexpr double kTillerUpturn_m = 0.05;  // length in which a tiller turns upright
constexpr double kNodLength_m = 0.12;     // of the peduncle, that bends with its ear
constexpr double kPeduncleRadiusShare = 0.5;
constexpr int kAxisPieces = 14;
constexpr std::uint64_t kMostShoots = 64;
constexpr std::uint64_t kMostRanks = 32;

class WheatShoot {
 public:
  // `number` is unique within the mesh; `first_rank`, on the main stem's scale, the lowest leaf.
  WheatShoot(const Traits& traits, std::uint64_t seed, std::uint64_t number, PlantBuilder& plant)
      : traits_(traits),
        seed_(seed),
        number_(number),
        plant_(plant),
        leaves_(traits.count("leaves")),
        unfolded_(std::min(traits.count("unfolded"), leaves_)),
        axis_(Vector3d::Zero()) {}

  void grow(const Vector3d& foot, double angle_rad, double azimuth_rad, int first_rank,
            double vigour) {
    RandomStream random(seed_, random_purpose("wheat/shoot"), number_);
    vigour_ = vigour * (1 + traits_["plant_variation"] * random.uniform(-1, 1));
    plane_rad_ = azimuth_rad + kUpright + random.uniform(-0.5, 0.5);
    lean_rad_ = traits_.radians("lean_deg") * random.uniform();
    lean_azimuth_rad_ = 2 * kPi * random.uniform();
    nod_rad_ = traits_.radians("ear_nod_deg") * random.uniform(0.6, 1.4);
    nod_azimuth_rad_ = 2 * kPi * random.uniform();
    grow_axis(foot, angle_rad, azimuth_rad);
    grow_stem();
    const int lowest_green = unfolded_ - traits_.count("green_leaves") + 1;
    const int lowest = std::max({first_rank, 1, lowest_green - traits_.count("dry_leaves")});
    for (int rank = lowest; rank <= unfolded_; ++rank) grow_leaf(rank, rank < lowest_green);
    if (unfolded_ < leaves_) grow_emerging_leaf();
    if (has_ear()) grow_ear(random);
  }

 private:
  bool in_tuft() const { return traits_["tuft_m"] > 0; }
  bool has_ear() const { return traits_.count("spikelets") > 0; }
  bool ripe() const { return traits_.count("ripe") > 0; }

  double stem_m() const { return vigour_ * traits_["stem_m"] * traits_["stem_share"]; }
  double ear_m() const { return has_ear() ? vigour_ * traits_["ear_m"] : 0; }

  // Length along the axis of the node of a leaf. The stem grows from its base: each internode after
  // the one below it.
  double node_m(int rank) const {
    const int elongated = rank - leaves_ + static_cast<int>(kInternodeShares.size()) - 1;
    double share = 0;
    for (int i = 0; i < elongated; ++i) share += kInternodeShares[static_cast<std::size_t>(i)];
    return std::min(vigour_ * traits_["stem_m"] * share, stem_m());
  }

  double collar_m(int rank) const {
    const RankProfile sheaths{.first_rank = 1,
                              .peak_rank = static_cast<double>(leaves_),
                              .last_rank = static_cast<double>(leaves_),
                              .first = 0.15,
                              .last = 1,
                              .rise_exponent = 1.5};
    return node_m(rank) + vigour_ * traits_["sheath_m"] * sheaths.at(rank);
  }

  // Where the shoot's stem, or its rolled sheaths, end.
  double top_m() const { return std::max(stem_m(), collar_m(unfolded_)); }

  // Turns upright from a tiller's angle, leans, and nods at its upper end.
  void grow_axis(const Vector3d& foot, double angle_rad, double azimuth_rad) {
    axis_ = Axis(foot);
    const double length = has_ear() ? std::max(top_m(), stem_m() + ear_m()) : top_m();
    const double nod_from = stem_m() - kNodLength_m;
    for (int i = 0; i < kAxisPieces; ++i) {
      const double at = length * (i + 0.5) / kAxisPieces;
      const double angle = angle_rad * (0.15 + 0.85 * std::exp(-at / kTillerUpturn_m));
      const Vector3d leaning = direction(azimuth_rad, kUpright - angle) +
                               std::tan(lean_rad_) * direction(lean_azimuth_rad_, 0);
      const double bent = std::clamp((at - nod_from) / (length - nod_from), 0.0, 1.0);
      const Eigen::AngleAxisd nod(nod_rad_ * std::pow(bent, 1.3),
                                  direction(nod_azimuth_rad_ + kUpright, 0));
      axis_.add(length / kAxisPieces * (nod * leaning.normalized()));
    }
  }

  void grow_stem() {
    constexpr int kPoints = 7;
    const double sheaths_end = collar_m(unfolded_);
    Tube stem{.path = axis_.part(0, top_m(), kPoints), .radius_m = {}, .sides = 4};
    for (int i = 0; i < kPoints; ++i) {
      const bool bare = top_m() * i / (kPoints - 1) > sheaths_end;
      const double taper = 1 - 0.3 * i / (kPoints - 1);
      stem.radius_m.push_back(vigour_ * traits_["stem_radius_m"] *
                              (bare ? kPeduncleRadiusShare : taper));
    }
    stem.light_points = in_tuft() ? 2 : 3;
    stem.light_sides = in_tuft() ? 2 : 3;
    plant_.tube(stem, ripe() ? "straw" : "stem");
  }

  GrassBlade blade(int rank, RandomStream& random) const {
    const RankProfile lengths{.first_rank = 1,
                              .peak_rank = leaves_ - 1.0,
                              .last_rank = static_cast<double>(leaves_),
                              .first = traits_["first_blade_share"],
                              .last = traits_["last_blade_share"],
                              .rise_exponent = 4};
    const RankProfile widths{.first_rank = 1,
                             .peak_rank = static_cast<double>(leaves_),
                             .last_rank = static_cast<double>(leaves_),
                             .first = 0.25,
                             .last = 1,
                             .rise_exponent = 3};
    const double spread = traits_.radians("azimuth_spread_deg") * random.uniform(-1, 1);
    return {.collar = axis_.at(collar_m(rank)),
            .azimuth_rad = plane_rad_ + rank * kPi + spread,
            .elevation_rad = kUpright - traits_.vary(traits_.radians("blade_angle_deg"), random),
            .bend_rad = traits_.radians("blade_bend_deg") * random.uniform(0.5, 1.25),
            .bend_exponent = random.uniform(1.3, 2.8),
            .twist_rad = traits_.radians("blade_twist_deg") * random.uniform(-1, 1),
            .length_m = traits_.vary(vigour_ * traits_["blade_m"] * lengths.at(rank), random),
            .width_m = traits_.vary(vigour_ * traits_["blade_width_m"] * widths.at(rank), random),
            .base_width_share = 0.75,
            .widest_at = 0.35,
            .points = 8,
            // A tuft has many leaves: in light detail all but each shoot's last are one triangle.
            .light_points = !in_tuft()          ? 4
                            : rank == unfolded_ ? 3
                                                : 2};
  }

  void grow_leaf(int rank, bool dry) {
    RandomStream random(seed_, random_purpose("wheat/leaf"), number_ * kMostRanks + rank);
    GrassBlade grown = blade(rank, random);
    if (dry) {
      // Limp and rolled in.
      grown.bend_rad = grown.elevation_rad + 1.3;
      grown.bend_exponent = 0.15;
      grown.width_m *= 0.45;
      grown.points = 6;
    }
    plant_.blade(grass_blade(grown), dry ? "dry" : "leaf");
  }

  // The tip of the next leaf, upright.
  void grow_emerging_leaf() {
    RandomStream random(seed_, random_purpose("wheat/leaf"), number_ * kMostRanks + unfolded_ + 1);
    GrassBlade grown = blade(unfolded_ + 1, random);
    grown.collar = axis_.at(top_m());
    grown.visible = random.uniform(0.25, 0.7);
    grown.elevation_rad = kUpright - (kUpright - grown.elevation_rad) / 3;
    grown.bend_rad /= 4;
    plant_.blade(grass_blade(grown), "leaf");
  }

  void grow_ear(RandomStream& random) {
    grow_wheat_ear({.foot_m = stem_m(),
                    .length_m = ear_m(),
                    .shown_from_m = collar_m(unfolded_),
                    .side_rad = 2 * kPi * random.uniform(),
                    .spikelets = traits_.count("spikelets"),
                    .spikelet_m = traits_["spikelet_m"],
                    .spikelet_radius_m = traits_["spikelet_radius_m"],
                    .awn_m = vigour_ * traits_["awn_m"],
                    .material = ripe() ? "ripe_ear" : "ear"},
                   axis_, random, plant_);
  }

  const Traits& traits_;
  std::uint64_t seed_;
  std::uint64_t number_;
  PlantBuilder& plant_;
  int leaves_;
  int unfolded_;
  Axis axis_;
  double vigour_ = 1;     // of this shoot's lengths
  double plane_rad_ = 0;  // azimuth of the plane in which its leaves stand
  double lean_rad_ = 0;
  double lean_azimuth_rad_ = 0;
  double nod_rad_ = 0;
  double nod_azimuth_rad_ = 0;
};

void grow_plant(const Traits& traits, std::uint64_t seed, std::uint64_t number,
                const Vector3d& foot, PlantBuilder& plant) {
  RandomStream random(seed, random_purpose("wheat/plant"), number);
  const double mean = traits["tillers"];
  const double spread = std::min(traits["tiller_spread"], mean);
  const double drawn = mean + spread * random.uniform(-1, 1) + random.uniform(-0.5, 0.5);
  const auto tillers = static_cast<int>(std::clamp(std::lround(drawn), 0L, 20L));
  const double azimuth = 2 * kPi * random.uniform();
  const std::uint64_t shoot = number * kMostShoots;
  WheatShoot(traits, seed, shoot, plant).grow(foot, 0, azimuth, 1, 1);
  for (int tiller = 1; tiller <= tillers; ++tiller) {
    // In the axils of the lowest leaves, which stand in two rows; a tiller's first leaf unfolds
    // with the main stem's third above its axil (Kirby 2002).
    const double turned = azimuth + tiller * kPi + random.uniform(-0.9, 0.9);
    const double angle = traits.radians("tiller_angle_deg") * random.uniform(0.6, 1.3);
    const int first_rank = std::min(tiller + 3, traits.count("unfolded"));
    WheatShoot(traits, seed, shoot + static_cast<std::uint64_t>(tiller), plant)
        .grow(foot + 0.004 * direction(turned, 0), angle, turned, first_rank,
              traits["tiller_vigour"]);
  }
}

}  // namespace

void grow_wheat(const Traits& traits, std::uint64_t seed, PlantBuilder& plant) {
  const double tuft_m = traits["tuft_m"];
  if (tuft_m <= 0) return grow_plant(traits, seed, 0, Vector3d::Zero(), plant);
  const auto plants = std::max(1L, std::lround(tuft_m * traits["tuft_plants_per_m"]));
  for (long i = 0; i < plants; ++i) {
    RandomStream random(seed, random_purpose("wheat/tuft"), static_cast<std::uint64_t>(i));
    // A drill drops its seeds unevenly, but within their share of the row.
    const double along = (static_cast<double>(i) + random.uniform()) / static_cast<double>(plants);
    const double aside = traits["tuft_width_m"] * (random.uniform() - 0.5);
    grow_plant(traits, seed, static_cast<std::uint64_t>(i), {tuft_m * (along - 0.5), aside, 0},
               plant);
  }
}

}  // namespace plotscan::crop
