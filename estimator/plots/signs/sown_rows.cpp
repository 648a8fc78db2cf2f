// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "plots/lattice/depth_profile.h"
#include "plots/layout/drill_rows.h"
#include "plots/signs/field_signs.h"

namespace plotscan::plots {
namespace {

constexpr double kLeastSownSpacing_m = 0.1, kMostSownSpacing_m = 1.2;
constexpr double kMostOff_m = 0.45;  // rows times spacing, from the size that the outline has
constexpr double kCoarse_m = 0.02, kFine_m = 0.005;  // steps of the spacing
constexpr double kClearly = 0.5;  // of the squares that an even canopy leaves: rows leave fewer

// Spreads of leaves about their row: stems and whorls are near it, blades farther away.
constexpr std::array kBlurs_m = {0.04, 0.06, 0.08, 0.12, 0.16, 0.2, 0.25, 0.3, 0.4};
constexpr double kBroader = 1.3;

// Residual squares of a profile after a least-squares fit of up to three curves.
class Curves {
 public:
  Curves(const Eigen::MatrixXd& curves, const Eigen::VectorXd& depth)
      : products_(curves.transpose() * curves),
        with_depth_(curves.transpose() * depth),
        squares_(depth.squaredNorm()) {}

  // Of these curves together; all of the squares where one of them would have a weight below 0.
  template <std::size_t count>
  double squares_left(const std::array<int, count>& used) const {
    const Eigen::Vector<double, count> right = with_depth_(used);
    const Eigen::Matrix<double, count, count> products = products_(used, used);
    const Eigen::Vector<double, count> weights = products.ldlt().solve(right);
    return weights.minCoeff() >= 0 ? std::max(0.0, squares_ - weights.dot(right)) : squares_;
  }

 private:
  Eigen::MatrixXd products_;
  Eigen::VectorXd with_depth_;
  double squares_;
};

// The canopy of a plot whose neighbours along r are as it is.
template <class Canopy>
Eigen::VectorXd curve_of(const DepthProfile& profile, const Neighbours& near,
                         const Canopy& canopy) {
  Eigen::VectorXd curve(static_cast<Eigen::Index>(profile.x_m.size()));
  for (std::size_t i = 0; i < profile.x_m.size(); ++i) {
    const double x = profile.x_m[i];
    curve[static_cast<Eigen::Index>(i)] = canopy(x) + near.depth(canopy, x);
  }
  return curve;
}

Eigen::VectorXd depth_of(const DepthProfile& profile) {
  return Eigen::Map<const Eigen::VectorXd>(profile.depth.data(),
                                           static_cast<Eigen::Index>(profile.depth.size()));
}

// Residual squares of a canopy; `canopy(blur_m)` is its shape for leaves of one spread. The best
// spread or the best two together are fitted, with or without a constant level.
template <class Canopy>
double squares_of(const DepthProfile& profile, const Neighbours& near, const Canopy& canopy) {
  constexpr auto kBlurs = static_cast<int>(kBlurs_m.size()), kLevel = kBlurs;
  Eigen::MatrixXd curves(static_cast<Eigen::Index>(profile.x_m.size()), kBlurs + 1);
  for (int blur = 0; blur < kBlurs; ++blur)
    curves.col(blur) = curve_of(profile, near, canopy(kBlurs_m[static_cast<std::size_t>(blur)]));
  curves.col(kLevel).setOnes();
  const Curves fit(curves, depth_of(profile));
  double least = fit.squares_left(std::array{kLevel});
  for (int near_row = 0; near_row < kBlurs; ++near_row) {
    least = std::min({least, fit.squares_left(std::array{near_row}),
                      fit.squares_left(std::array{near_row, kLevel})});
    for (int farther = near_row + 1; farther < kBlurs; ++farther) {
      if (kBlurs_m[static_cast<std::size_t>(farther)] <
          kBroader * kBlurs_m[static_cast<std::size_t>(near_row)])
        continue;
      least = std::min({least, fit.squares_left(std::array{near_row, farther}),
                        fit.squares_left(std::array{near_row, farther, kLevel})});
    }
  }
  return least;
}

// Residual squares of the best even canopy, its edges as free as those of the rows.
double squares_of_even_canopy(const DepthProfile& profile, const Neighbours& near, double size_m) {
  double least = std::numeric_limits<double>::infinity();
  const double smallest_m = std::max(0.2, size_m - kMostOff_m);
  const auto steps = static_cast<int>((size_m + kMostOff_m - smallest_m) / kCoarse_m);
  for (int step = 0; step <= steps; ++step) {
    const auto canopy = [&](double blur_m) {
      return BlurredBox(smallest_m + step * kCoarse_m, blur_m);
    };
    least = std::min(least, squares_of(profile, near, canopy));
  }
  return least;
}

// Residual squares of rows at equal steps, whatever the shape of their leaves.
double squares_of_rows(const DepthProfile& profile, const Neighbours& near, const SownRows& rows) {
  return squares_of(profile, near, [&](double blur_m) {
    return [&, blur_m](double x_m) {
      double canopy = 0;
      for (int row = 0; row < rows.rows; ++row) {
        const double off = (x_m - (row - 0.5 * (rows.rows - 1)) * rows.spacing_m) / blur_m;
        if (std::abs(off) < 4) canopy += std::exp(-0.5 * off * off);
      }
      return canopy;
    };
  });
}

struct RowsFit {
  SownRows rows;
  double squares = std::numeric_limits<double>::infinity();
};

// The best spacing, within [low_m, high_m], of this number of rows.
RowsFit best_spacing(const DepthProfile& profile, const Neighbours& near, int rows, double low_m,
                     double high_m, double step_m) {
  RowsFit best;
  const auto steps = static_cast<int>(std::floor((high_m - low_m) / step_m + 1e-9));
  for (int i = 0; i <= steps; ++i) {
    const SownRows tried{.rows = rows, .spacing_m = low_m + i * step_m};
    const double squares = squares_of_rows(profile, near, tried);
    if (squares < best.squares) best = {tried, squares};
  }
  return best;
}

}  // namespace

std::optional<SownRows> sown_rows_along(const Lattice& lattice) {
  const double size_m = lattice.r.size_m;
  const DepthProfile profile = profile_with_gaps(lattice);
  const Neighbours near = neighbours_of(lattice);
  RowsFit best;
  for (int rows = 2; rows <= kMostSownRows; ++rows) {
    const double low_m = std::max(kLeastSownSpacing_m, (size_m - kMostOff_m) / rows);
    const double high_m = std::min(kMostSownSpacing_m, (size_m + kMostOff_m) / rows);
    const RowsFit fit = best_spacing(profile, near, rows, low_m, high_m, kCoarse_m);
    if (fit.squares < best.squares) best = fit;
  }
  if (best.squares >= kClearly * squares_of_even_canopy(profile, near, size_m)) return std::nullopt;
  const double about_m = best.rows.spacing_m;
  return best_spacing(profile, near, best.rows.rows, about_m - kCoarse_m, about_m + kCoarse_m,
                      kFine_m)
      .rows;
}

}  // namespace plotscan::plots
