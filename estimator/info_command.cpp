// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include <fmt/core.h>

#include "cloud_options.h"
#include "commands.h"
#include "core/text.h"
#include "inspect/cloud_report.h"

namespace plotscan {
namespace {

void say_points(const Program& program, const scan::CloudFacts& facts) {
  std::string left_out;
  if (facts.not_finite > 0)
    left_out += fmt::format(", {} more have no place (not finite, or no pose at their time)",
                            facts.not_finite);
  if (facts.marked > 0) left_out += fmt::format(", {} marked as withheld or noise", facts.marked);
  program.say("format     " + facts.format);
  program.say("points     {}{}", facts.points, left_out);
}

void say_extent(const Program& program, const scan::CloudFacts& facts) {
  const int digits = facts.system.zone ? 6 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    program.say("{:10} {} {:.{}f} to {:.{}f}", axis == 0 ? "extent" : "", "xyz"[axis],
                facts.bounds.min()[axis], axis < 2 ? digits : 2, facts.bounds.max()[axis],
                axis < 2 ? digits : 2);
  }
}

void say_system(const Program& program, const scan::CloudSystem& system, bool stated) {
  const bool is_stated =
      stated || !system.crs.empty() || system.zone || system.units != CoordinateUnits{};
  const std::string x_y = system.zone ? "degrees" : unit_name(system.units.horizontal_m);
  program.say("units      " + x_y + ", z in " + unit_name(system.units.vertical_m) +
              (is_stated ? "" : ", as nothing else is stated (--units)"));
  program.say("system     " + (system.crs.empty() ? "not stated" : scan::crs_name(system.crs)));
  for (const std::string& note : system.notes) program.say("note       " + note);
}

void say_density(const Program& program, const cloud::FieldDensity& density) {
  const Eigen::Vector2d sides_m = cloud::sides_of(density.field);
  program.say("field      {:.0f} x {:.0f} m around, {:.2f} ha scanned densely", sides_m.x(),
              sides_m.y(), density.area_m2 / 1e4);
  program.say("density    {} points/m2 (median), {} in the thinnest 5 %, in squares of {} m",
              cloud::density_text(density.median), cloud::density_text(density.least5),
              density.square_m);
}

// "1 62.5 %, 2 37.5 %"
std::string shares(const scan::CountByNumber& counts, std::uint64_t points, bool named) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const std::string name = named ? inspect::class_name(i) : "";
    text += fmt::format("{}{}{}{}{} {:.1f} %", text.empty() ? "" : ", ", i,
                        name.empty() ? "" : " (", name, name.empty() ? "" : ")",
                        100 * static_cast<double>(counts[i]) / static_cast<double>(points));
  }
  return text;
}

void say_fields(const Program& program, const scan::CloudFacts& facts) {
  program.say("fields     " + joined(facts.fields, ", "));
  if (facts.returns) program.say("returns    " + shares(*facts.returns, facts.points, false));
  if (facts.classes) program.say("classes    " + shares(*facts.classes, facts.points, true));
  if (facts.utc) {
    program.say("time       " + format_utc((*facts.utc)[0]) + " to " + format_utc((*facts.utc)[1]));
  } else if (facts.time_s) {
    program.say("time       {:.3f} to {:.3f} s", (*facts.time_s)[0], (*facts.time_s)[1]);
  }
}

void say_verdict(const Program& program, const inspect::CloudReport& report) {
  const char* verdict = !report.obstacles.empty() ? "no"
                        : report.doubts.empty()   ? "yes"
                                                  : "perhaps";
  program.say("plots      {}, as far as density and classes tell", verdict);
  for (const std::string& why : report.obstacles) program.say("           " + why);
  for (const std::string& why : report.doubts) program.say("           " + why);
}

void run_info(const Program& program, const CloudArguments& arguments) {
  CloudFiles cloud = cloud_of(arguments);
  cloud.files = cloud_files_of(cloud.files);
  const inspect::CloudReport report = inspect::inspect_cloud(cloud);
  if (cloud.files.size() > 1) program.say("files      {}", cloud.files.size());
  say_points(program, report.facts);
  say_extent(program, report.facts);
  say_system(program, report.facts.system, cloud.units.has_value());
  say_density(program, report.density);
  say_fields(program, report.facts);
  say_verdict(program, report);
  program.result(inspect::to_json(report));
}

}  // namespace

void declare_info(Program& program) {
  const auto arguments = std::make_shared<CloudArguments>();
  CLI::App& info =
      program.command("info", "Print what a cloud holds, and whether plots can be found in it.",
                      [&program, arguments] { run_info(program, *arguments); });
  declare_cloud(info, *arguments);
}

}  // namespace plotscan
