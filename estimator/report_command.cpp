// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>

#include <fmt/core.h>

#include "cloud_options.h"
#include "commands.h"
#include "fieldpage/field_page.h"
#include "report/shown_cloud.h"

namespace plotscan {
namespace {

struct ReportArguments {
  fieldpage::PageOptions options;
  CloudArguments cloud;
};

void make_page(const Program& program, ReportArguments& arguments) {
  fieldpage::PageOptions& options = arguments.options;
  if (!arguments.cloud.cloud.files.empty()) options.cloud = cloud_of(arguments.cloud);
  const report::PageSummary summary =
      fieldpage::write_estimate_page(options, program.progress("making the page"));
  const auto bytes = std::filesystem::file_size(options.html);
  program.result({{"page", options.html.string()},
                  {"plots", summary.plots},
                  {"points_read", summary.read},
                  {"points_shown", summary.shown},
                  {"notes", summary.notes},
                  {"bytes", bytes}});
  const std::string points = options.cloud ? fmt::format(" {:.2f} of {:.2f} million points,",
                                                         1e-6 * static_cast<double>(summary.shown),
                                                         1e-6 * static_cast<double>(summary.read))
                                           : "";
  program.say("{}: {} plots,{} {:.1f} MB", options.html.string(), summary.plots, points,
              1e-6 * static_cast<double>(bytes));
  for (const std::string& note : summary.notes) program.say("note       " + note);
  if (!options.cloud) program.say("With --cloud it shows the points, too.");
  program.say("Open it in a browser; it needs no network.");
}

}  // namespace

void declare_report(Program& program) {
  const auto shared = std::make_shared<ReportArguments>();
  fieldpage::PageOptions& options = shared->options;
  CLI::App& report =
      program.command("report", "Make a report of an estimate, to open in a browser (HTML).",
                      [&program, shared] { make_page(program, *shared); });
  report
      .add_option(
          "EST", options.estimate,
          "estimate folder, or a GeoJSON file of plots with numbers height_<name>_m, metres")
      ->required();
  report.add_option("-o,--output", options.html, "page to write (.html)")->required();
  report.add_option(
      "--truth", options.truth,
      "farm folder, a GeoJSON file of plots with numbers height_<name>_m, metres, or a "
      "table (.csv) of heights that were measured in the field: errors are shown");
  report.add_option("--id", options.id, kIdOfMeasured)->needs("--truth");
  declare_shown_cloud(report, shared->cloud);
  report.add_option("--points", options.points, "points on the page, at most")
      ->check(CLI::Range(std::size_t{1}, report::kMostPoints))
      ->needs("--cloud");
  report.add_flag("--force", options.replace, "replace an existing page");
}

}  // namespace plotscan
