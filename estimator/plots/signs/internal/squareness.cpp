// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "plots/signs/internal/plot_shape.h"

namespace plotscan::plots {
namespace {

// Range around a plot that its outline is judged on: half the gap to the next plot, within these
// limits.
constexpr double kLeastAround_m = 0.1, kAround_m = 0.4;
constexpr int kFitRounds = 20;      // of least squares in turn
constexpr double kMostStretch = 2;  // of ellipses, from the ratio of the plots' own sides,
constexpr int kStretches = 10;      // in so many steps up and down
constexpr double kNone = 1e-12;
// Of the canopy's squares about its mean: shapes that leave less are equally good. A bell is a
// product too. Functions of the distance leave 0.03 of conifers, 0.2 and more of plots.
constexpr double kSameLeft = 0.05;

// The plots' mean canopy by cell along r and c, and whether anything was seen there, 1 or 0.
struct MeanPlot {
  Eigen::ArrayXXd canopy, seen;
};

MeanPlot mean_plot(const Lattice& lattice, double around_m) {
  const RowView& view = lattice.view;
  const auto cells = [&](double size_m) {
    return static_cast<Eigen::Index>((size_m + 2 * around_m) / view.cell_m());
  };
  MeanPlot plot;
  plot.canopy.setZero(cells(lattice.r.size_m), cells(lattice.c.size_m));
  plot.seen = plot.canopy;
  for (const Place& place : lattice.places) {
    const CellBox box = cells_about(lattice, place, around_m);
    for (Eigen::Index i = 0; i < plot.canopy.rows(); ++i) {
      for (Eigen::Index k = 0; k < plot.canopy.cols(); ++k) {
        const int r = box.r0 + static_cast<int>(i), c = box.c0 + static_cast<int>(k);
        if (view.seen_cells(r, r + 1, c, c + 1) == 0) continue;
        plot.canopy(i, k) += view.cover(r, r + 1, c, c + 1);
        plot.seen(i, k) += 1;
      }
    }
  }
  plot.canopy /= plot.seen.max(1);
  plot.seen = plot.seen.min(1);
  return plot;
}

// An outline's sides over those of the mean plot.
struct Outline {
  double r_scale = 1, c_scale = 1;
};

// Where the middle of a cell lies on a side, whose ends are -1 and 1.
double place_on_side(Eigen::Index cell, Eigen::Index cells, double scale) {
  return (2 * (static_cast<double>(cell) + 0.5) / static_cast<double>(cells) - 1) / scale;
}

// Residual squares about one level inside an outline and one outside.
template <class Inside>
double squares_about_levels(const MeanPlot& plot, const Outline& outline, const Inside& inside) {
  double n[2] = {}, sum[2] = {}, squares = 0;
  for (Eigen::Index i = 0; i < plot.canopy.rows(); ++i) {
    const double y = place_on_side(i, plot.canopy.rows(), outline.r_scale);
    for (Eigen::Index k = 0; k < plot.canopy.cols(); ++k) {
      if (plot.seen(i, k) == 0) continue;
      const double canopy = plot.canopy(i, k);
      const int in = inside(place_on_side(k, plot.canopy.cols(), outline.c_scale), y) ? 1 : 0;
      n[in] += 1;
      sum[in] += canopy;
      squares += canopy * canopy;
    }
  }
  return squares - sum[0] * sum[0] / std::max(1.0, n[0]) - sum[1] * sum[1] / std::max(1.0, n[1]);
}

// A mean plot's sums over the first cells of each row.
class RowSums {
 public:
  explicit RowSums(const MeanPlot& plot) {
    canopy_.setZero(plot.canopy.rows(), plot.canopy.cols() + 1);
    seen_ = canopy_;
    for (Eigen::Index k = 0; k < plot.canopy.cols(); ++k) {
      canopy_.col(k + 1) = canopy_.col(k) + plot.canopy.col(k);
      seen_.col(k + 1) = seen_.col(k) + plot.seen.col(k);
    }
  }

  // How much of the squares the two levels explain. The outline has no dents and its halves are
  // alike: what is inside of a row is one stretch about the row's middle.
  template <class Inside>
  double explained(const Outline& outline, const Inside& inside) const {
    std::vector<double> x;
    for (Eigen::Index k = 0; k + 1 < canopy_.cols(); ++k)
      x.push_back(place_on_side(k, canopy_.cols() - 1, outline.c_scale));
    const auto middle = x.begin() + std::ssize(x) / 2;
    double n = 0, sum = 0;
    for (Eigen::Index i = 0; i < canopy_.rows(); ++i) {
      const double y = place_on_side(i, canopy_.rows(), outline.r_scale);
      const auto is_in = [&](double along) { return inside(along, y); };
      const auto first = std::partition_point(x.begin(), middle, std::not_fn(is_in)) - x.begin();
      const auto end = std::partition_point(middle, x.end(), is_in) - x.begin();
      n += seen_(i, end) - seen_(i, first);
      sum += canopy_(i, end) - canopy_(i, first);
    }
    const double beyond = canopy_.rightCols(1).sum() - sum;
    const double n_beyond = seen_.rightCols(1).sum() - n;
    return sum * sum / std::max(1.0, n) + beyond * beyond / std::max(1.0, n_beyond);
  }

 private:
  Eigen::ArrayXXd canopy_, seen_;
};

// The least residual squares of outlines of all sizes.
template <class Inside>
double squares_of_outline(const MeanPlot& plot, const Inside& inside) {
  constexpr int kScales = 17;
  const auto scale_of = [](int step) { return 0.6 + 0.05 * step; };
  const RowSums sums(plot);
  Outline best;
  double most = -1;
  for (int step = 0; step < kScales * kScales; ++step) {
    const Outline outline{scale_of(step / kScales), scale_of(step % kScales)};
    const double explained = sums.explained(outline, inside);
    if (explained <= most) continue;
    most = explained;
    best = outline;
  }
  return squares_about_levels(plot, best, inside);
}

// Residual squares of level + along(r) * across(c), all at least 0; each is fitted in turn.
double squares_of_product(const MeanPlot& plot) {
  Eigen::ArrayXd along = Eigen::ArrayXd::Ones(plot.canopy.rows());
  Eigen::ArrayXd across = Eigen::ArrayXd::Ones(plot.canopy.cols());
  double level = 0, squares = 0;
  for (int round = 0; round < kFitRounds; ++round) {
    const Eigen::ArrayXXd above = (plot.canopy - level) * plot.seen;
    const auto weights = plot.seen.matrix();
    along = (above.matrix() * across.matrix()).array() /
            (weights * across.square().matrix()).array().max(kNone);
    along = along.max(0);
    across = (above.matrix().transpose() * along.matrix()).array() /
             (weights.transpose() * along.square().matrix()).array().max(kNone);
    across = across.max(0);
    const Eigen::ArrayXXd rest =
        plot.canopy - (along.matrix() * across.matrix().transpose()).array();
    level = std::max(0.0, (rest * plot.seen).sum() / std::max(kNone, plot.seen.sum()));
    squares = ((rest - level).square() * plot.seen).sum();
  }
  return squares;
}

// Residual squares with one level for each elliptic ring, a cell wide; `stretch` changes the ratio
// of the axes from the plot's own.
double squares_of_rings(const MeanPlot& plot, double stretch) {
  const Eigen::Index rows = plot.canopy.rows(), columns = plot.canopy.cols();
  const auto rings = static_cast<std::size_t>((rows + columns) / 2);
  std::vector<double> count(rings + 1), sum(rings + 1), squares(rings + 1);
  const double corner = std::hypot(1, stretch);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double y = stretch * (2 * (static_cast<double>(i) + 0.5) / static_cast<double>(rows) - 1);
    for (Eigen::Index k = 0; k < columns; ++k) {
      if (plot.seen(i, k) == 0) continue;
      const double x = 2 * (static_cast<double>(k) + 0.5) / static_cast<double>(columns) - 1;
      const double part = std::hypot(x, y) / corner;
      const auto ring = static_cast<std::size_t>(part * static_cast<double>(rings));
      const double canopy = plot.canopy(i, k);
      count[ring] += 1;
      sum[ring] += canopy;
      squares[ring] += canopy * canopy;
    }
  }
  double left = 0;
  for (std::size_t ring = 0; ring <= rings; ++ring)
    left += squares[ring] - sum[ring] * sum[ring] / std::max(1.0, count[ring]);
  return left;
}

double squares_about_mean(const MeanPlot& plot) {
  const double level = (plot.canopy * plot.seen).sum() / std::max(1.0, plot.seen.sum());
  return ((plot.canopy - level).square() * plot.seen).sum();
}

double squares_of_ellipses(const MeanPlot& plot) {
  double least = std::numeric_limits<double>::infinity();
  for (int step = -kStretches; step <= kStretches; ++step)
    least =
        std::min(least, squares_of_rings(plot, std::pow(kMostStretch, 1.0 * step / kStretches)));
  return least;
}

}  // namespace

Squareness squareness_of(const Lattice& lattice) {
  const auto half_gap = [](double pitch_m, double size_m) {
    return pitch_m > 0 ? std::max(0.0, (pitch_m - size_m) / 2) : kAround_m;
  };
  const double around_m = std::clamp(std::min(half_gap(lattice.r.pitch_m, lattice.r.size_m),
                                              half_gap(lattice.c.pitch_m, lattice.c.size_m)),
                                     kLeastAround_m, kAround_m);
  const MeanPlot plot = mean_plot(lattice, around_m);
  const double ellipse =
      squares_of_outline(plot, [](double x, double y) { return x * x + y * y < 1; });
  const double rectangle = squares_of_outline(
      plot, [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 1; });
  const double same = std::max(kNone, kSameLeft * squares_about_mean(plot));
  return {.of_outline = ellipse / std::max(kNone, rectangle),
          .of_canopy = (squares_of_ellipses(plot) + same) / (squares_of_product(plot) + same)};
}

}  // namespace plotscan::plots
