// SPDX-License-Identifier: Apache-2.0
#pragma once

// How well a layout explains a field, cell by cell.

#include <cstdint>
#include <vector>

#include "plots/layout/layout.h"

namespace plotscan::plots {

// Schwarz's criterion of layouts on a raster: their likelihood, with the lines on which plots begin
// as parameters. Canopy levels do not count as parameters: in every layout each piece of canopy has
// its own, so a layout with more plots does not fit an uneven canopy better. Where plots touch, no
// gap stands out, but the rows that they are sown in may: what all plots have in common of them is
// explained too, a parameter for each leaf's width of it.
class LayoutCriterion {
 public:
  // Refers to the raster.
  explicit LayoutCriterion(const CanopyRaster& raster);
  // The less, the better. A layout without rows: nothing but one level.
  double operator()(const Layout& layout) const;
  // By how much a layout with rows explains the canopy better than one level does, nats: in its
  // outline and half a metre around. How much bare ground was scanned beyond makes no difference.
  double evidence_in_outline(const Layout& layout) const;

 private:
  struct Sums;
  struct Area;
  struct RowsOfPlots;

  Sums sums_over(const RowView& view, const Band& r, const Band& c) const;
  RowsOfPlots rows_along(bool along_c, const Layout& layout) const;
  double left_in_piece(const RowView& view, const Band& r, const Band& c, const RowsOfPlots& rows,
                       int from) const;
  double variation_left(const Layout& layout, const Area& area, const RowsOfPlots* rows) const;
  double cost(const Layout& layout, const Area& area) const;

  const CanopyRaster& raster_;
  double per_cell_;                     // independent observations
  std::vector<std::uint64_t> squared_;  // summed-area table of the cells' canopy, squared
};

}  // namespace plotscan::plots
