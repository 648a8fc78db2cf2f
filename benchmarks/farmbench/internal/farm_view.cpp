// SPDX-License-Identifier: Apache-2.0
#include "farmbench/internal/farm_view.h"

#include <algorithm>

#include "core/error.h"
#include "core/output_file.h"
#include "fieldpage/shown.h"
#include "report/shown_field.h"
#include "scanpage/read_cloud.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;

std::size_t view_points(const Suite& suite) {
  constexpr std::size_t kAll = 4'000'000;
  constexpr std::size_t kOne = 1'000'000;
  return std::clamp<std::size_t>(kAll / suite.cases.size(), 50'000, kOne);
}

fs::path farm_view_file(const fs::path& output, const std::string& farm) {
  return output / "views" / (farm + ".cbor");
}

void write_farm_view(const fs::path& file, const FarmView& view) {
  scanpage::ShownScan scan = scanpage::read_shown_scan(
      view.scan, {.most = view.points,
                  .area = Eigen::AlignedBox2d(Eigen::Vector2d(view.area[0], view.area[1]),
                                              Eigen::Vector2d(view.area[2], view.area[3]))});
  const estimate::Estimate& first = view.estimates.front();
  report::ShownField field{.name = view.result.case_name};
  field.facts = {{"seed", std::to_string(view.result.seed)},
                 {"method", first.method},
                 {"points of the scan", std::to_string(view.result.points)}};
  fieldpage::show_estimate(field, first);
  for (const estimate::Estimate& estimate : view.estimates)
    fieldpage::show_working(field, estimate);
  fieldpage::show_truth(field, first, view.truth);
  fieldpage::show_terrain(field, view.terrain);
  if (!view.result.methods.front().failure.empty())
    field.notes.push_back(view.result.methods.front().failure);
  field.path = std::move(scan.path);
  field.cloud = std::move(scan.cloud);
  const std::vector<std::uint8_t> bytes = nlohmann::json::to_cbor(report::packed_field(field));
  write_whole_file(file, std::string(bytes.begin(), bytes.end()));
}

std::optional<nlohmann::json> read_farm_view(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    return nlohmann::json::from_cbor(read_text(file));
  } catch (const nlohmann::json::exception&) {
    throw InputError(file,
                     "is no view of a farm; farmbench run makes it again where it is missing");
  }
}

}  // namespace plotscan::farmbench
