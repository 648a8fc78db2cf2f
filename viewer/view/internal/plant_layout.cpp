// SPDX-License-Identifier: Apache-2.0
#include "view/internal/plant_layout.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/error.h"

namespace plotscan::view {
namespace {

constexpr double kMargin_px = 14;      // at the picture's edges
constexpr double kLeastGap_px = 12;    // between plants, and between rows
constexpr double kLabelStrip_px = 28;  // below the plants of a row
constexpr double kLargest_px_per_m = 1e6;
constexpr double kSmallest_px_per_m = 1e-3;

struct Size {
  double width_px = 0;
  double height_px = 0;
};

double cell_px(const PlantExtent& plant, double px_per_m) {
  return std::max((plant.left_m + plant.right_m) * px_per_m, plant.label_px) + kLeastGap_px;
}

// The rows without their places in the picture.
std::vector<PlantRow> rows_of(const std::vector<PlantExtent>& plants, std::size_t columns) {
  std::vector<PlantRow> rows;
  for (std::size_t first = 0; first < plants.size(); first += columns) {
    PlantRow row;
    row.first = first;
    row.count = std::min(columns, plants.size() - first);
    for (std::size_t i = 0; i < row.count; ++i)
      row.above_m = std::max(row.above_m, plants[first + i].above_m);
    rows.push_back(row);
  }
  return rows;
}

double below_m(const std::vector<PlantExtent>& plants, const PlantRow& row) {
  double below = 0;
  for (std::size_t i = 0; i < row.count; ++i)
    below = std::max(below, plants[row.first + i].below_m);
  return below;
}

double row_width_px(const std::vector<PlantExtent>& plants, const PlantRow& row, double px_per_m) {
  double width = 0;
  for (std::size_t i = 0; i < row.count; ++i) width += cell_px(plants[row.first + i], px_per_m);
  return width;
}

double row_height_px(const std::vector<PlantExtent>& plants, const PlantRow& row, double px_per_m) {
  return (row.above_m + below_m(plants, row)) * px_per_m + kLabelStrip_px + kLeastGap_px;
}

Size size_of(const std::vector<PlantExtent>& plants, const std::vector<PlantRow>& rows,
             double px_per_m) {
  Size size;
  for (const PlantRow& row : rows) {
    size.width_px = std::max(size.width_px, row_width_px(plants, row, px_per_m));
    size.height_px += row_height_px(plants, row, px_per_m);
  }
  size.width_px += kScaleWidth_px + kMargin_px;
  size.height_px += kMargin_px;
  return size;
}

// The largest scale at which the rows fit, or 0.
double scale_of(const std::vector<PlantExtent>& plants, const std::vector<PlantRow>& rows,
                const Eigen::Vector2d& picture_px) {
  const auto fits = [&](double px_per_m) {
    const Size size = size_of(plants, rows, px_per_m);
    return size.width_px <= picture_px.x() && size.height_px <= picture_px.y();
  };
  double low = kSmallest_px_per_m;
  double high = kLargest_px_per_m;
  if (!fits(low)) return 0;
  // Halving a range of 9 decades 60 times leaves nothing that a pixel shows.
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

// Divides the remaining room of the picture among the gaps between plants and between rows.
void place(const std::vector<PlantExtent>& plants, const Eigen::Vector2d& picture_px,
           PlantLayout& layout) {
  const Size size = size_of(plants, layout.rows, layout.px_per_m);
  const double air_px = (picture_px.y() - size.height_px) / static_cast<double>(layout.rows.size());
  double top = picture_px.y() - kMargin_px;
  layout.feet.resize(plants.size());
  for (PlantRow& row : layout.rows) {
    const double height = row_height_px(plants, row, layout.px_per_m) + air_px;
    row.label_px = top - height + kLeastGap_px + kLabelStrip_px / 2;
    row.ground_px =
        row.label_px + kLabelStrip_px / 2 + below_m(plants, row) * layout.px_per_m + air_px / 2;
    top -= height;
    const double spare =
        picture_px.x() - kScaleWidth_px - kMargin_px - row_width_px(plants, row, layout.px_per_m);
    const double gap = spare / static_cast<double>(row.count + 1);
    double x = kScaleWidth_px + gap;
    for (std::size_t i = row.first; i < row.first + row.count; ++i) {
      const double cell = cell_px(plants[i], layout.px_per_m);
      const double offset = (plants[i].left_m - plants[i].right_m) / 2 * layout.px_per_m;
      layout.feet[i] = {x + cell / 2 + offset, row.ground_px};
      x += cell + gap;
    }
  }
}

}  // namespace

PlantLayout lay_out(const std::vector<PlantExtent>& plants, const Eigen::Vector2d& picture_px,
                    std::size_t columns) {
  PlantLayout best;
  const std::size_t least = columns == 0 ? 1 : columns;
  const std::size_t most = columns == 0 ? plants.size() : columns;
  for (std::size_t count = least; count <= most; ++count) {
    std::vector<PlantRow> rows = rows_of(plants, count);
    const double px_per_m = scale_of(plants, rows, picture_px);
    if (px_per_m > best.px_per_m) best = {px_per_m, std::move(rows), {}};
  }
  if (best.rows.empty()) {
    throw InputError(fmt::format(
        "{} plants with their labels do not fit into {} x {} pixels; take a larger picture, fewer "
        "plants or other columns",
        plants.size(), static_cast<int>(picture_px.x()), static_cast<int>(picture_px.y())));
  }
  place(plants, picture_px, best);
  return best;
}

}  // namespace plotscan::view
