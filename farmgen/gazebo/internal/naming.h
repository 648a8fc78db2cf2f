// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// How exported worlds name their models and links, so that a plot or plant can be found by its
// name, and read back from it:
//
//   merge  model                   link             visual
//   plot   plot_12                 link             leaf, stem, ...
//   row    row_3 (1)               plot_12          leaf, stem, ...
//   none   plot_12_plant_345       link             visual
//
// (1) trial_2_row_3 where the farm has several trials.
//
// Weeds stand in models of their own, since Gazebo labels whole models: plot_12_weeds, row_3_weeds
// (with links plot_12_weeds). Plants of no plot are in plants_outside_plots, _weeds, and with a
// tile's number behind where they are many; with merge none they are plant_345. A farm folder's
// own world.sdf has models plot_12 with visuals plant_345. The class of a surface is its
// laser_retro (farm/surface_class.h).
namespace plotscan::gazebo {

// row_3; trial_2_row_3 where the farm has several trials (farm::Plot::trial above 0).
std::string row_model_name(int trial, int row);
std::string plant_model_name(std::uint32_t plot, std::uint32_t plant);
// `name` + "_weeds".
std::string weeds_name(const std::string& name);
// plants_outside_plots_3
std::string outside_model_name(std::uint32_t tile);

// The plot that a model, link or visual belongs to by its name, or none: N of plot_N and plot_N_*.
std::optional<std::uint32_t> plot_in_name(std::string_view name);
// The plant that a model, link or visual is by its name, or none: M of plant_M and *_plant_M.
std::optional<std::uint32_t> plant_in_name(std::string_view name);

}  // namespace plotscan::gazebo
