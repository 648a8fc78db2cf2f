// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "calibration/field_sample.h"
#include "calibration/fit.h"

#include "core/error.h"
#include "core/program.h"
#include "core/text_file.h"

namespace {

using namespace plotscan;
namespace fs = std::filesystem;

struct SampleArguments {
  fs::path libraries;
  fs::path output;
  int farms = 8;
  bool true_ground = false;
};

void run_sample(const Program& program, const SampleArguments& arguments) {
  const std::vector<calibration::Library> libraries =
      calibration::read_libraries(arguments.libraries);
  const fs::path base = arguments.libraries.parent_path() / "farm.yaml";
  fs::create_directories(arguments.output);
  const auto progress = program.progress("sample");
  for (int number = 0; number < arguments.farms; ++number) {
    for (std::size_t i = 0; i < libraries.size(); ++i) {
      const calibration::FarmPlan plan = calibration::plan_farm(libraries[i], i, number);
      const fs::path file = arguments.output / (plan.library + "-" + std::to_string(plan.seed));
      if (!fs::exists(file)) {
        calibration::write_sample(
            file,
            calibration::sample_field(plan, base,
                                      arguments.true_ground ? calibration::GroundSource::truth
                                                            : calibration::GroundSource::fitted,
                                      arguments.output, program.common().threads));
      }
      if (progress)
        progress((number + static_cast<double>(i + 1) / static_cast<double>(libraries.size())) /
                 arguments.farms);
    }
  }
}

// Numbers to 5 digits, which is more than they mean.
nlohmann::json rounded(nlohmann::json document) {
  if (document.is_number_float()) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.5g", document.get<double>());
    return std::stod(text.data());
  }
  if (document.is_structured())
    for (auto& entry : document) entry = rounded(entry);
  return document;
}

struct FitArguments {
  std::vector<fs::path> samples;
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

void run_fit(const Program& program, const FitArguments& arguments) {
  std::vector<calibration::MeasuredField> fields;
  for (const fs::path& file : sample_files(arguments.samples)) {
    calibration::MeasuredField field = calibration::measure(calibration::read_sample(file));
    if (!field.plots.empty()) fields.push_back(std::move(field));
  }
  if (fields.empty()) throw InputError("there is no sample in the folders given");
  const heights::Calibration fitted = calibration::fit(fields);
  TextFile file(arguments.output);
  file << rounded(heights::json_of(fitted)).dump(1) << "\n";
  file.close();
  for (const calibration::LeftOut& row : calibration::leave_library_out(fitted)) {
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(),
                  "%-20s %-11s %4zu farms  rmse %5.2f %%  bias %+5.2f %%  inside %5.1f %%",
                  row.library.c_str(), row.height.c_str(), row.farms, 100 * row.rmse,
                  100 * row.bias, 100 * row.inside);
    program.say(line.data());
  }
}

}  // namespace

int main(int argc, char** argv) {
  Program program("heightcal", "Calibrate crop heights on virtual farms (docs/plot-heights.md).");
  SampleArguments arguments;
  CLI::App& sample = program.command("sample", "Fly over farms of every plant library.",
                                     [&] { run_sample(program, arguments); });
  sample.add_option("LIBRARIES", arguments.libraries, "plant libraries (YAML)")->required();
  sample
      .add_option("-o,--output", arguments.output,
                  "folder of samples; farms that it holds are not flown again")
      ->required();
  sample.add_option("--farms", arguments.farms, "farms of each library")->check(CLI::Range(1, 100));
  sample.add_flag("--true-ground", arguments.true_ground,
                  "heights above the true terrain in place of the fitted one");
  FitArguments fit_arguments;
  CLI::App& fit = program.command("fit", "Fit the calibration to samples.",
                                  [&] { run_fit(program, fit_arguments); });
  fit.add_option("SAMPLES", fit_arguments.samples, "folders of samples")->required();
  fit.add_option("-o,--output", fit_arguments.output, "calibration (JSON) to write")->required();
  return program.run(argc, argv);
}
