// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "core/stopwatch.h"
#include "core/text.h"
#include "record/formats.h"
#include "report/shown_cloud.h"
#include "scanpage/scan_page.h"

namespace plotscan {
namespace {

void view_scan(const Program& program, scanpage::PageOptions& options) {
  const Stopwatch watch;
  options.threads = program.common().threads;
  const report::PageSummary summary =
      scanpage::write_scan_page(options, program.progress("making the page"));
  const auto bytes = std::filesystem::file_size(options.html);
  program.result({{"page", options.html.string()},
                  {"points_read", summary.read},
                  {"points_shown", summary.shown},
                  {"plots", summary.plots},
                  {"notes", summary.notes},
                  {"bytes", bytes},
                  {"seconds", watch.seconds()}});
  program.say("{}: {:.2f} of {:.2f} million points, {:.1f} MB, made in {:.1f} s",
              options.html.string(), 1e-6 * static_cast<double>(summary.shown),
              1e-6 * static_cast<double>(summary.read), 1e-6 * static_cast<double>(bytes),
              watch.seconds());
  for (const std::string& note : summary.notes) program.say("note       " + note);
  program.say("Open it in a browser; it needs no network.");
}

std::string recordings_with_poses() {
  return joined(record::extensions_of([](const record::Format& format) {
                  return format.is_recording && format.has_topics;
                }),
                ", ");
}

}  // namespace

void declare_view(Program& program) {
  const auto options = std::make_shared<scanpage::PageOptions>();
  CLI::App& view =
      program.command("view", "Make a page of a scan, to open in a browser (HTML).",
                      [&program, options] { view_scan(program, *options); }, {.threads = true});
  view.add_option("SCAN", options->scan,
                  "scan folder, cloud (" + record::readable_clouds() +
                      ") or recording that knows its poses (" + recordings_with_poses() + ")")
      ->required();
  view.add_option("-o,--output", options->html, "page to write (.html)")->required();
  view.add_option("--plots", options->plots,
                  "boxes to show: a farm or estimate folder, or a map of plots (GeoJSON) in the "
                  "cloud's frame");
  view.add_option("--points", options->points, "points on the page, at most")
      ->check(CLI::Range(std::size_t{1}, report::kMostPoints));
  view.add_option("--topic", options->source.topic,
                  "of a bag or MCAP: the topic of its clouds (default: /velodyne_points, or the "
                  "only one)");
  view.add_flag("--force", options->replace, "replace an existing page");
}

}  // namespace plotscan
