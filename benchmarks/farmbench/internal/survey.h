// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "cloud/area.h"

#include "core/progress.h"
#include "farm/farm.h"
#include "lidar/fly.h"
#include "scan/point.h"
#include "score/score.h"

// Surveys of a part of a field (docs/benchmark.md).
namespace plotscan::farmbench {

// Only plots that lie wholly in the survey stay scored. Throws InputError when none does.
void leave_to_survey(std::vector<score::TruePlot>& plots, const cloud::Area& survey);

// Flies strips over the rectangle in place of the farm's plots. Throws InputError as lidar::fly
// does.
lidar::FlySummary fly_survey(const farm::Farm& farm, const cloud::Area& survey,
                             const std::filesystem::path& folder, const lidar::FlyOptions& flight,
                             const ProgressReport& progress);

// Hands on to `sink` the points that lie in the area; their positions are relative to origin_m.
scan::PointSink only_inside(const cloud::Area& area, const Eigen::Vector3d& origin_m,
                            const scan::PointSink& sink);

// Writes those points of a cloud, with all that is known of them, that lie in the area.
void crop_cloud(const std::filesystem::path& cloud, const cloud::Area& area,
                const std::filesystem::path& cropped);

}  // namespace plotscan::farmbench
