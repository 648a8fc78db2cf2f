// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entry/entered_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "core/error.h"
#include "core/statistics.h"
#include "core/text.h"
#include "core/trial_layout.h"
#include "estimate/height_properties.h"
#include "farmbench/entry/internal/entered_rows.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;
namespace {

using nlohmann::json;

constexpr std::uintmax_t kMostBytes = 64'000'000;
constexpr double kFarthest_m = 1e7;

// The property where it is there and not null.
const json* stated(const EnteredRow& row, const std::string& name) {
  const auto found = row.properties.find(name);
  return found == row.properties.end() || found->is_null() ? nullptr : &*found;
}

// A property that has to be a number where it is there; absent where it is not one.
std::optional<double> number_in(const EnteredRow& row, const std::string& name,
                                Problems& problems) {
  const json* value = stated(row, name);
  if (value == nullptr) return std::nullopt;
  if (value->is_number() && estimate::is_plausible(value->get<double>()))
    return value->get<double>();
  problems.add(row.place, name + " is " + value->dump() + "; it must be metres, -100 to 1000");
  return std::nullopt;
}

// The height's interval where one is stated: both ends, in their order.
void read_interval(const EnteredRow& row, const std::string& height, estimate::PlotEstimate& plot,
                   Problems& problems) {
  const auto standard = number_in(row, estimate::property_of(height, estimate::kError), problems);
  const auto low = number_in(row, estimate::property_of(height, estimate::kLow), problems);
  const auto high = number_in(row, estimate::property_of(height, estimate::kHigh), problems);
  if (standard && !(*standard >= 0))
    problems.add(row.place, "a standard error is not negative, and that of " +
                                estimate::property_of(height) + " is");
  if (!low && !high) return;
  if (!low || !high || *low > *high) {
    problems.add(row.place, "the interval of " + estimate::property_of(height) +
                                " has two ends, low95_ and high95_, the first not above the other");
    return;
  }
  plot.errors[height] = {
      .standard_error_m = standard.value_or(kNaN), .low95_m = *low, .high95_m = *high};
}

void read_heights(const EnteredRow& row, estimate::PlotEstimate& plot, Problems& problems) {
  for (const auto& [property, value] : row.properties.items()) {
    const std::string height = estimate::height_of(property);
    if (height.empty()) continue;
    if (!is_table_name(height)) {
      problems.add(row.place, "\"" + property +
                                  "\" names a height; such a name is 1 to 40 letters, digits, '-' "
                                  "and '_'");
      continue;
    }
    if (const auto height_m = number_in(row, property, problems)) {
      plot.heights_m[height] = *height_m;
      read_interval(row, height, plot, problems);
    }
  }
  for (const auto& [property, value] : row.properties.items()) {
    for (const std::string_view before : {estimate::kLow, estimate::kHigh}) {
      if (!property.starts_with(before) || value.is_null()) continue;
      const std::string height = property.substr(before.size());
      if (!estimate::height_of(height).empty() && stated(row, height) == nullptr)
        problems.add(row.place,
                     fmt::format("{} belongs to {}, which is not there", property, height));
    }
  }
}

void read_trust(const EnteredRow& row, estimate::PlotEstimate& plot, Problems& problems) {
  if (const json* confidence = stated(row, "confidence")) {
    if (confidence->is_number() && *confidence >= 0 && *confidence <= 1)
      plot.confidence = confidence->get<double>();
    else
      problems.add(row.place, "confidence is " + confidence->dump() + "; it must be 0 to 1");
  }
  const json* flags = stated(row, "flags");
  if (flags == nullptr) return;
  const auto is_text = [](const json& flag) { return flag.is_string(); };
  if (!flags->is_array() || !std::ranges::all_of(*flags, is_text))
    return problems.add(row.place, "flags is " + flags->dump() +
                                       "; it must be a list of texts, or a text with semicolons "
                                       "between the reasons");
  for (const json& flag : *flags) plot.flags.push_back(flag.get<std::string>());
}

bool is_sound(const PlotBox& box) {
  return box.width_m > 0 && box.length_m > 0 && box.width_m < kFarthest_m &&
         box.length_m < kFarthest_m && std::isfinite(box.heading_rad) &&
         box.center.array().abs().maxCoeff() < kFarthest_m;
}

estimate::PlotEstimate plot_of(const EnteredRow& row, std::size_t number, Problems& problems) {
  estimate::PlotEstimate plot{.id = number, .box = row.box.value_or(PlotBox{})};
  if (const json* id = stated(row, "plot_number")) {
    if (const auto number_or_text = PlotId::from(*id))
      plot.id = *number_or_text;
    else
      problems.add(row.place, "plot_number is " + id->dump() + "; it must be a number or a text");
  } else if (!row.box_stated) {
    problems.add(row.place, "has neither a box nor a plot_number that names a given one");
  }
  if (row.box && !is_sound(plot.box))
    problems.add(row.place, "its box has no width and length above 0, or lies beyond 10,000 km");
  read_heights(row, plot, problems);
  read_trust(row, plot, problems);
  return plot;
}

void require_different_ids(const EnteredPlots& entered, Problems& problems) {
  std::map<PlotId, std::string> places;
  for (std::size_t i = 0; i < entered.plots.size(); ++i) {
    const auto [first, is_new] = places.emplace(entered.plots[i].id, entered.places[i]);
    if (!is_new)
      problems.add(entered.places[i], "plot_number " + entered.plots[i].id.text() + " stands in " +
                                          first->second + " as well");
  }
}

std::vector<EnteredRow> read_rows(const fs::path& file, Problems& problems) {
  const std::string name = file.filename().string();
  if (fs::is_symlink(file) || !fs::is_regular_file(file)) {
    problems.add(name, "is no file");
    return {};
  }
  if (fs::file_size(file) > kMostBytes) {
    problems.add(name, "is larger than 64 MB");
    return {};
  }
  const std::string text = read_text(file);
  const std::string_view unmarked = without_byte_order_mark(text);
  const std::size_t first = unmarked.find_first_not_of(" \t\r\n");
  const bool is_json = first != std::string_view::npos && unmarked[first] == '{';
  std::vector<EnteredRow> rows =
      is_json ? read_entered_features(file, problems) : read_entered_table(file, problems);
  if (rows.size() > kMostPlots) {
    problems.add(name, fmt::format("has {} plots; {} are the most", rows.size(), kMostPlots));
    rows.clear();
  }
  return rows;
}

}  // namespace

bool is_table_name(const std::string& name) {
  constexpr std::string_view kCharacters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  return !name.empty() && name.size() <= 40 &&
         name.find_first_not_of(kCharacters) == std::string::npos;
}

EnteredPlots read_entered_plots(const fs::path& file, Problems& problems) {
  EnteredPlots entered;
  const std::vector<EnteredRow> rows = read_rows(file, problems);
  std::size_t boxes = 0;
  for (const EnteredRow& row : rows) {
    entered.plots.push_back(plot_of(row, entered.plots.size() + 1, problems));
    entered.places.push_back(row.place);
    if (row.box_stated) ++boxes;
  }
  if (boxes > 0 && boxes < rows.size())
    problems.add(file.filename().string(),
                 fmt::format("{} of its {} plots have boxes; all do, or none", boxes, rows.size()));
  entered.boxes_stated = rows.empty() || boxes > 0;
  require_different_ids(entered, problems);
  return entered;
}

void take_boxes(EnteredPlots& entered, const std::vector<score::TruePlot>& truth,
                Problems& problems) {
  if (entered.boxes_stated) return;
  for (std::size_t i = 0; i < entered.plots.size(); ++i) {
    const auto plot = std::ranges::find_if(truth, [&](const score::TruePlot& candidate) {
      return candidate.scored && candidate.id == entered.plots[i].id;
    });
    if (plot == truth.end())
      problems.add(entered.places[i], "no box has the plot_number " + entered.plots[i].id.text());
    else
      entered.plots[i].box = plot->box;
  }
}

}  // namespace plotscan::farmbench
