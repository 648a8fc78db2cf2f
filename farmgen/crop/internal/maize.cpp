// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "core/random.h"
#include "crop/internal/axis.h"
#include "crop/internal/form.h"
#include "crop/internal/grass.h"

namespace plotscan::crop {
namespace {

using Eigen::Vector3d;

constexpr int kElongatingInternodes = 3;  // at once, below the last collar
constexpr double kStemTopShare = 0.3;     // radius at the top over that at the foot
constexpr double kSheathRadiusShare = 1.18;
constexpr int kSilks = 14;
constexpr int kLightSilks = 2;

class MaizePlant {
 public:
  MaizePlant(const Traits& traits, std::uint64_t seed, PlantBuilder& plant)
      : traits_(traits),
        seed_(seed),
        plant_(plant),
        leaves_(traits.count("leaves")),
        collars_(std::min(traits.count("collars"), leaves_)),
        stem_(Vector3d::Zero()) {
    RandomStream random(seed, random_purpose("maize/plant"), 0);
    vigour_ = 1 + traits["plant_variation"] * random.uniform(-1, 1);
    plane_rad_ = 2 * kPi * random.uniform();
    lean_azimuth_rad_ = 2 * kPi * random.uniform();
    lean_rad_ = traits.radians("lean_deg") * random.uniform();
  }

  void grow() {
    grow_stem();
    const int first = std::min(traits_.count("shed_leaves"), collars_) + 1;
    for (int rank = first; rank <= collars_; ++rank) grow_leaf(rank);
    const int last = std::min(leaves_, collars_ + traits_.count("whorl_leaves"));
    for (int rank = collars_ + 1; rank <= last; ++rank) grow_whorl_leaf(rank);
    if (traits_["ear_m"] > 0) grow_ear();
    if (traits_["tassel_m"] > 0) grow_tassel();
  }

 private:
  bool mature() const { return collars_ == leaves_; }

  // An internode elongates while the collars about it appear (Fournier & Andrieu 2000).
  double internode_m(int rank) const {
    if (rank < traits_["first_internode"]) return 0;
    const RankProfile lengths{.first_rank = traits_["first_internode"],
                              .peak_rank = traits_["longest_internode_share"] * leaves_,
                              .last_rank = static_cast<double>(leaves_),
                              .first = 0.2,
                              .last = 0.7};
    const double elongated =
        mature() ? 1 : std::clamp((collars_ + 1.0 - rank) / kElongatingInternodes, 0.0, 1.0);
    return vigour_ * traits_["internode_m"] * lengths.at(rank) * elongated;
  }

  double sheath_m(int rank) const {
    const RankProfile lengths{.first_rank = 1,
                              .peak_rank = 0.5 * leaves_,
                              .last_rank = static_cast<double>(leaves_),
                              .first = 0.16,
                              .last = 0.8,
                              .rise_exponent = 1.4};
    return vigour_ * traits_["sheath_m"] * lengths.at(rank);
  }

  double blade_m(int rank) const {
    const RankProfile lengths{.first_rank = 1,
                              .peak_rank = traits_["longest_blade_share"] * leaves_,
                              .last_rank = static_cast<double>(leaves_),
                              .first = 0.06,
                              .last = traits_["last_blade_share"],
                              .rise_exponent = 1.4};
    return vigour_ * traits_["blade_m"] * lengths.at(rank);
  }

  double blade_width_m(int rank) const {
    const RankProfile widths{.first_rank = 1,
                             .peak_rank = traits_["longest_blade_share"] * leaves_,
                             .last_rank = static_cast<double>(leaves_),
                             .first = 0.14,
                             .last = 0.62};
    return vigour_ * traits_["blade_width_m"] * widths.at(rank);
  }

  // The nodes, then the peduncle under the tassel, or the rolled sheaths up to the last collar.
  void grow_stem() {
    const double lean = lean_rad_;
    const double kink = traits_["variation"] * 0.2;
    node_m_.assign(1, 0);
    for (int rank = 1; rank <= leaves_; ++rank) {
      RandomStream random(seed_, random_purpose("maize/internode"), rank);
      const double length = traits_.vary(internode_m(rank), random);
      // The stem turns a little at each node, away from its leaf.
      const Vector3d aside = direction(leaf_azimuth(rank), 0) * (kink * random.uniform());
      stem_.add(length * (direction(lean_azimuth_rad_, kUpright - lean) - aside).normalized());
      node_m_.push_back(node_m_.back() + length);
    }
    const double top =
        mature() ? traits_["peduncle_m"] * vigour_ : collar_m(collars_) - node_m_.back();
    stem_.add(std::max(top, 1e-3) * direction(lean_azimuth_rad_, kUpright - lean));
    const int points = 2 * leaves_;
    Tube stem{.path = stem_.part(0, stem_.length_m(), points), .radius_m = {}};
    for (int i = 0; i < points; ++i)
      stem.radius_m.push_back(radius_m(stem_.length_m() * i / (points - 1)));
    stem.light_points = mature() ? 4 : 2;
    plant_.tube(stem, "stem");
  }

  double collar_m(int rank) const {
    return node_m_[static_cast<std::size_t>(rank)] + sheath_m(rank);
  }

  double radius_m(double length_m) const {
    const double share = std::clamp(length_m / std::max(stem_.length_m(), 1e-3), 0.0, 1.0);
    // A pseudostem of sheaths keeps its width; a stem tapers.
    const double taper = mature() ? 1 - kStemTopShare : 0.35;
    return vigour_ * traits_["stem_radius_m"] * (1 - taper * share);
  }

  double leaf_azimuth(int rank) const {
    RandomStream random(seed_, random_purpose("maize/azimuth"), rank);
    return plane_rad_ + rank * kPi + traits_.radians("azimuth_spread_deg") * random.uniform(-1, 1);
  }

  // Lower leaves open wide, the upper ones stand upright and bend less.
  GrassBlade blade(int rank, RandomStream& random) const {
    const double share = static_cast<double>(rank) / leaves_;
    const double open = 1.35 - 0.6 * share;
    const double bending = 1.15 - 0.5 * std::max(0.0, share - 0.5) / 0.5;
    return {
        .collar = stem_.at(collar_m(rank)),
        .azimuth_rad = leaf_azimuth(rank),
        .elevation_rad = kUpright - traits_.vary(traits_.radians("blade_angle_deg") * open, random),
        .bend_rad = traits_.vary(traits_.radians("blade_bend_deg") * bending, random),
        .bend_exponent = 1.7,
        .twist_rad = 0.5 * random.uniform(-1, 1),
        .undulation_rad = traits_.radians("undulation_deg"),
        .undulation_waves = 3,
        .undulation_phase = 2 * kPi * random.uniform(),
        .length_m = traits_.vary(blade_m(rank), random),
        .width_m = traits_.vary(blade_width_m(rank), random),
        .base_width_share = 0.6,
        .widest_at = 0.4,
        .fold_rad = traits_.radians("fold_deg"),
        .points = 15,
        .light_points = 6};
  }

  void grow_leaf(int rank) {
    RandomStream random(seed_, random_purpose("maize/leaf"), rank);
    grow_sheath(rank);
    GrassBlade grown = blade(rank, random);
    // A blade bends under its weight in the weeks after its collar has appeared.
    const double age = mature() ? 1 : std::min(1.0, 0.55 + 0.15 * (collars_ - rank));
    grown.bend_rad *= age;
    const bool dry = rank <= traits_.count("shed_leaves") + traits_.count("dry_leaves");
    if (dry) {
      // Broken at its collar it hangs beside the stem, narrow and short for it has shrivelled.
      grown.elevation_rad = -1.15;
      grown.bend_rad = 0.35;
      grown.bend_exponent = 1;
      grown.width_m *= 0.5;
      grown.length_m = std::min(0.7 * grown.length_m, grown.collar.z());
    }
    plant_.blade(grass_blade(grown), dry ? "dry" : "leaf");
  }

  void grow_sheath(int rank) {
    const double from = node_m_[static_cast<std::size_t>(rank)];
    const double to = collar_m(rank);
    // In light detail the stem stands for its sheaths.
    if (plant_.light() || to - from < 1e-3) return;
    const double radius = kSheathRadiusShare * std::max(radius_m(from), radius_m(to));
    plant_.tube(
        {.path = stem_.part(from, to, 3), .radius_m = {radius, radius, 1.15 * radius}, .sides = 7},
        "stem");
  }

  // A leaf that still grows out of the sheaths: its tip, upright.
  void grow_whorl_leaf(int rank) {
    RandomStream random(seed_, random_purpose("maize/leaf"), rank);
    const double young = static_cast<double>(rank - collars_) / (traits_["whorl_leaves"] + 1);
    GrassBlade grown = blade(rank, random);
    grown.collar = stem_.at(stem_.length_m());
    grown.visible = std::max(0.1, 0.78 * (1 - young));
    grown.elevation_rad = kUpright - (kUpright - grown.elevation_rad) * (0.75 - 0.5 * young);
    grown.bend_rad *= 0.75 * (1 - young);
    plant_.blade(grass_blade(grown), "leaf");
  }

  void grow_ear() {
    RandomStream random(seed_, random_purpose("maize/ear"), 0);
    const int rank =
        std::clamp(static_cast<int>(std::lround(traits_["ear_node_share"] * leaves_)), 1, leaves_);
    const double node = node_m_[static_cast<std::size_t>(rank)];
    const double azimuth = leaf_azimuth(rank);
    const double angle = traits_.vary(traits_.radians("ear_angle_deg"), random);
    const double length = traits_.vary(traits_["ear_m"] * vigour_, random);
    const double widest = traits_.vary(traits_["ear_radius_m"] * vigour_, random);
    const Vector3d axis = direction(azimuth, kUpright - angle);
    const Vector3d base = stem_.at(node) + direction(azimuth, 0) * radius_m(node);
    constexpr int kPoints = 8;
    Tube ear{.path = {}, .radius_m = {}, .sides = 9, .light_points = 4, .light_sides = 4};
    for (int i = 0; i < kPoints; ++i) {
      const double share = static_cast<double>(i) / (kPoints - 1);
      ear.path.push_back(base + share * length * axis);
      // A shank, the cob, the husk's tip.
      ear.radius_m.push_back(widest * (0.25 + 0.75 * std::pow(std::sin(2.6 * share + 0.2), 0.7)));
    }
    ear.closed_tip = true;
    plant_.tube(ear, "husk");
    if (traits_["silk_m"] > 0) grow_silks(base + length * axis, axis, random);
  }

  // A tuft that rises from the husk and falls over.
  void grow_silks(const Vector3d& tip, const Vector3d& axis, RandomStream& random) {
    const int count = plant_.light() ? kLightSilks : kSilks;
    for (int silk = 0; silk < count; ++silk) {
      const Vector3d aside =
          direction(2 * kPi * (silk + random.uniform()) / count, random.uniform(-0.5, 0.5));
      const double length = traits_["silk_m"] * random.uniform(0.7, 1);
      const Vector3d up = tip + 0.4 * length * (axis + 0.4 * aside);
      const Vector3d end = up + 0.6 * length * (aside - Vector3d::UnitZ()).normalized();
      plant_.tube({.path = {tip - 0.01 * axis, up, end},
                   .radius_m = {0.0025, 0.002, 0},
                   .sides = 2,
                   .light_points = 3,
                   .light_sides = 2},
                  "silk");
    }
  }

  void grow_tassel() {
    const double foot = stem_.length_m();
    const double length = vigour_ * traits_["tassel_m"];
    RandomStream random(seed_, random_purpose("maize/tassel"), 0);
    const Vector3d base = stem_.at(foot);
    const Vector3d axis = (stem_.heading(foot) + 0.12 * direction(plane_rad_, 0)).normalized();
    plant_.tube({.path = {base, base + 0.35 * length * axis, base + 0.75 * length * axis,
                          base + length * axis},
                 .radius_m = {0.003, 0.0055, 0.005, 0.0015},
                 .sides = 5,
                 .light_points = 2,
                 .light_sides = 3},
                "tassel");
    const int branches = traits_.count("tassel_branches");
    for (int branch = 0; branch < branches; ++branch) {
      // On the spike's lower third, the lowest the longest.
      const double share = static_cast<double>(branch) / branches;
      const double reach = length * traits_.vary(0.75 - 0.25 * share, random);
      const double azimuth = branch * 137.5 * kDegrees + random.uniform(-0.3, 0.3);
      grow_tassel_branch(base + share * 0.33 * length * axis, azimuth, reach, random);
    }
  }

  void grow_tassel_branch(const Vector3d& foot, double azimuth, double reach,
                          RandomStream& random) {
    constexpr int kPieces = 4;
    const double angle = traits_.vary(traits_.radians("tassel_angle_deg"), random);
    const double droop = random.uniform(0.1, 0.9);
    Tube tube{.path = {foot}, .radius_m = {0.002}, .sides = 4, .light_points = 3, .light_sides = 2};
    for (int i = 1; i <= kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const double elevation = kUpright - angle - droop * share;
      tube.path.push_back(tube.path.back() + reach / kPieces * direction(azimuth, elevation));
      tube.radius_m.push_back(i == kPieces ? 0.001 : 0.0032);
    }
    plant_.tube(tube, "tassel");
  }

  const Traits& traits_;
  std::uint64_t seed_;
  PlantBuilder& plant_;
  int leaves_;
  int collars_;
  double vigour_ = 1;     // of this plant's lengths
  double plane_rad_ = 0;  // azimuth of the plane in which its leaves stand
  double lean_azimuth_rad_ = 0;
  double lean_rad_ = 0;
  Axis stem_;
  std::vector<double> node_m_;  // length along the stem of node 0 (the foot), 1, 2, ...
};

}  // namespace

void grow_maize(const Traits& traits, std::uint64_t seed, PlantBuilder& plant) {
  MaizePlant(traits, seed, plant).grow();
}

}  // namespace plotscan::crop
