// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/cloud_files.h"
#include "core/progress.h"
#include "estimate/estimate.h"
#include "report/shown_cloud.h"
#include "report/shown_field.h"
#include "score/measured_table.h"
#include "score/score.h"
#include "terrain/terrain.h"

namespace plotscan::fieldpage {

// Puts an estimate into a field: its plots and its ground.
void show_estimate(report::ShownField& field, const estimate::Estimate& estimate);

// Adds intermediate results of the method, where the estimate has them: clusters, planes of ground.
void show_working(report::ShownField& field, const estimate::Estimate& estimate);

// Compares the field's plots, which are the estimate's, with true ones: adds which are found, their
// true heights, and the true boxes.
void show_truth(report::ShownField& field, const estimate::Estimate& estimate,
                const std::vector<score::TruePlot>& truth);

// Puts what people measured beside the heights of these plots; returns how many they are.
std::size_t show_measured(report::ShownField& field, const score::MeasuredPlots& measured);

// The true ground at the nodes of the field's fitted ground, else around its plots.
void show_terrain(report::ShownField& field, const terrain::Terrain& terrain);

// A fair sample of a cloud's positions, at most `most` of them. Throws InputError as
// record::read_positions does.
report::ShownCloud read_shown_positions(const CloudFiles& cloud, std::size_t most,
                                        const ProgressReport& progress = {});

}  // namespace plotscan::fieldpage
