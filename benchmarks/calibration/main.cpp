// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string>

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "calibration/field_sample.h"
#include "calibration/fit.h"
#include "calibration/leave_out.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/program.h"
#include "core/text_file.h"

namespace {

using namespace plotscan;
namespace fs = std::filesystem;

struct SampleArguments {
  fs::path libraries;
  std::string ranges;
  fs::path output;
  int farms = 8;
  bool true_ground = false;
};

fs::path file_of(const calibration::FarmPlan& plan, const fs::path& folder) {
  return folder / (plan.library + "-" + std::to_string(plan.seed));
}

// Plans of the farms that the folder does not hold yet.
std::vector<calibration::FarmPlan> missing_plans(const SampleArguments& arguments) {
  const std::vector<calibration::Library> libraries =
      calibration::read_libraries(arguments.libraries, arguments.ranges);
  std::vector<calibration::FarmPlan> plans;
  for (int number = 0; number < arguments.farms; ++number) {
    for (std::size_t i = 0; i < libraries.size(); ++i) {
      calibration::FarmPlan plan = calibration::plan_farm(libraries[i], i, number);
      if (!fs::exists(file_of(plan, arguments.output))) plans.push_back(std::move(plan));
    }
  }
  return plans;
}

// Each farm on one thread, as many farms at a time as there are threads.
void run_sample(const Program& program, const SampleArguments& arguments) {
  const fs::path base = arguments.libraries.parent_path() / "farm.yaml";
  const auto source =
      arguments.true_ground ? calibration::GroundSource::truth : calibration::GroundSource::fitted;
  const std::vector<calibration::FarmPlan> plans = missing_plans(arguments);
  fs::create_directories(arguments.output);
  const auto progress = program.progress("sample");
  std::mutex reporting;
  std::size_t done = 0;
  const auto sample = [&](std::size_t i) {
    calibration::write_sample(
        file_of(plans[i], arguments.output),
        calibration::sample_field(plans[i], base, source, arguments.output, 1));
    const std::scoped_lock lock(reporting);
    done += 1;
    if (progress) progress(static_cast<double>(done) / static_cast<double>(plans.size()));
  };
  tbb::task_arena arena(program.common().threads);
  arena.execute(
      [&] { tbb::parallel_for(std::size_t{0}, plans.size(), sample, tbb::simple_partitioner()); });
}

// Numbers to 5 digits, which is more than they mean.
nlohmann::json rounded(nlohmann::json document) {
  if (document.is_number_float()) return std::stod(fmt::format("{:.5g}", document.get<double>()));
  if (document.is_structured())
    for (auto& entry : document) entry = rounded(entry);
  return document;
}

struct FitArguments {
  std::vector<fs::path> samples;
  fs::path extended;
  fs::path output;
};

std::vector<fs::path> sample_files(const std::vector<fs::path>& folders) {
  std::vector<fs::path> files;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<calibration::MeasuredField> measured_fields(const std::vector<fs::path>& files,
                                                        calibration::Returns returns) {
  std::vector<calibration::MeasuredField> fields(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    fields[i] = calibration::measure(calibration::read_sample(files[i]), returns);
  });
  std::erase_if(fields, [](const auto& field) { return field.plots.empty(); });
  if (fields.empty()) throw InputError("there is no sample in the folders given");
  return fields;
}

// A line a library, crop and height, rmse (bias) and the share inside the interval: with the farm
// left out, then with its library, each with the crop derived from the canopy and given; last, if
// stated, with the library where rays straight down without any error were measured, the crop
// given.
void print_left_out(const Program& program, const heights::Calibration& fitted,
                    const std::vector<calibration::LeftOut>& limits) {
  using calibration::Group;
  using calibration::LeftOut;
  const std::vector<LeftOut> farms = leave_out(fitted, Group::farm);
  const std::vector<LeftOut> libraries = leave_out(fitted, Group::library);
  const auto figures = [](const char* what, const calibration::Errors& errors) {
    return fmt::format("  {} {:5.2f} ({:+5.2f}) cm, {:5.1f} %", what, 100 * errors.rmse_m,
                       100 * errors.bias_m, 100 * errors.inside);
  };
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    const LeftOut& row = libraries[i];
    const auto limit = std::ranges::find_if(limits, [&](const LeftOut& other) {
      return other.name == row.name && other.height == row.height;
    });
    program.say(fmt::format("{:20} {:11} {:4}", row.name, row.height, row.farms) +
                figures("farm out", farms[i].recognised) + figures("crop given", farms[i].given) +
                figures("library out", row.recognised) + figures("crop given", row.given) +
                (limit == limits.end()
                     ? ""
                     : fmt::format("  perfect rays {:5.2f} cm", 100 * limit->given.rmse_m)));
  }
}

// Compact: a line for each of the document's members, and for each farm.
void write_calibration(const fs::path& output, const heights::Calibration& fitted) {
  TextFile file(output);
  const nlohmann::json document = rounded(heights::json_of(fitted));
  file << "{\n";
  for (const auto& [key, value] : document.items())
    if (key != "farms") file << "\"" << key << "\": " << value.dump() << ",\n";
  file << "\"farms\": [\n";
  const nlohmann::json& farms = document["farms"];
  for (std::size_t i = 0; i < farms.size(); ++i)
    file << farms[i].dump() << (i + 1 < farms.size() ? ",\n" : "\n");
  file << "]}\n";
  file.close();
}

heights::Calibration read_calibration(const fs::path& file) {
  try {
    return heights::calibration_of(read_json(file));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file.string() + ": is no calibration: " + error.what());
  }
}

void run_fit(const Program& program, const FitArguments& arguments) {
  using calibration::Returns;
  const std::vector<fs::path> files = sample_files(arguments.samples);
  if (!arguments.extended.empty()) {
    const heights::Calibration before = read_calibration(arguments.extended);
    const heights::Calibration extended =
        calibration::extended(before, measured_fields(files, Returns::thinned));
    write_calibration(arguments.output, extended);
    print_left_out(program, extended, {});
    return;
  }
  const heights::Calibration fitted = calibration::fit(measured_fields(files, Returns::thinned));
  write_calibration(arguments.output, fitted);
  const heights::Calibration perfect = calibration::fit(measured_fields(files, Returns::perfect));
  print_left_out(program, fitted, leave_out(perfect, calibration::Group::library));
}

}  // namespace

int main(int argc, char** argv) {
  Program program("heightcal",
                  "Calibrate crop heights on virtual farms (docs/plot-heights-calibration.md).");
  SampleArguments arguments;
  CLI::App& sample =
      program.command("sample", "Fly over farms of every plant library.",
                      [&] { run_sample(program, arguments); }, {.threads = true, .json = false});
  sample.add_option("LIBRARIES", arguments.libraries, "plant libraries (YAML)")->required();
  sample.add_option("RANGES", arguments.ranges, "of the parameters: usual or wide")->required();
  sample
      .add_option("-o,--output", arguments.output,
                  "folder of samples; farms that it holds are not flown again")
      ->required();
  sample.add_option("--farms", arguments.farms, "farms of each library")->check(CLI::Range(1, 100));
  sample.add_flag("--true-ground", arguments.true_ground,
                  "heights above the true terrain in place of the fitted one");
  FitArguments fit_arguments;
  CLI::App& fit = program.command("fit", "Fit the calibration to samples.",
                                  [&] { run_fit(program, fit_arguments); }, {.json = false});
  fit.add_option("SAMPLES", fit_arguments.samples, "folders of samples")->required();
  fit.add_option("--extend", fit_arguments.extended,
                 "calibration (JSON) to which the farms of the samples are added");
  fit.add_option("-o,--output", fit_arguments.output, "calibration (JSON) to write")->required();
  return program.run(argc, argv);
}
