// SPDX-License-Identifier: Apache-2.0
#include "farmbench/entries.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/contains.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/output_file.h"
#include "score/score_files.h"

namespace plotscan::farmbench {
namespace fs = std::filesystem;

using nlohmann::json;

void to_json(json& document, const EnteredFarm& farm) {
  document = {{"case", farm.case_name},
              {"seed", farm.seed},
              {"field", farm.field},
              {"farm_sha256", farm.farm_sha256},
              {"cloud_sha256", farm.cloud_sha256},
              {"file_sha256", farm.file_sha256},
              {"failure", farm.result.failure},
              {"score", farm.result.score}};
}

void from_json(const json& document, EnteredFarm& farm) {
  farm = {.case_name = document.at("case"),
          .seed = document.at("seed"),
          .field = document.at("field"),
          .farm_sha256 = document.at("farm_sha256"),
          .cloud_sha256 = document.at("cloud_sha256"),
          .file_sha256 = document.at("file_sha256"),
          .result = {.failure = document.at("failure"), .score = document.at("score")}};
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Entry, method, suite, program_sha256, scorer_sha256, farms)

namespace {

// A farm that is there twice would count twice.
void require_different_farms(const Entry& entry, const fs::path& file) {
  std::set<std::pair<std::string, std::uint64_t>> farms;
  for (const EnteredFarm& farm : entry.farms) {
    if (!farms.emplace(farm.case_name, farm.seed).second)
      throw InputError(
          file,
          "has two farms of case {}, seed {}; score the submission again, or remove this file",
          farm.case_name, farm.seed);
  }
}

Entry read_entry(const fs::path& file) {
  try {
    auto entry = json::parse(read_json_text(file)).get<Entry>();
    for (EnteredFarm& farm : entry.farms) farm.result.method = entry.method;
    require_different_farms(entry, file);
    return entry;
  } catch (const json::exception& error) {
    throw InputError(file, "not what farmbench score writes: " + json_reason(error));
  }
}

bool is_same_truth(const score::FieldScore& a, const score::FieldScore& b) {
  return std::ranges::equal(a.plots, b.plots, [](const auto& one, const auto& other) {
    return one.truth.id == other.truth.id && one.truth.heights_m == other.truth.heights_m;
  });
}

template <class Farms>
auto farm_in(Farms& farms, const EnteredFarm& farm) {
  return std::ranges::find_if(farms, [&](const FarmResult& candidate) {
    return candidate.case_name == farm.case_name && candidate.seed == farm.seed;
  });
}

fs::path file_of(const fs::path& output, const Entry& entry) {
  return output / "entries" / (entry.method + ".json");
}

// The entries of a results folder by their files.
std::map<fs::path, Entry> read_entries(const fs::path& output) {
  std::map<fs::path, Entry> entries;
  if (!fs::is_directory(output / "entries")) return entries;
  for (const auto& file : fs::directory_iterator(output / "entries")) {
    if (file.path().extension() == ".json") entries.emplace(file.path(), read_entry(file.path()));
  }
  return entries;
}

void require_new_name(const Entry& entry, const fs::path& file,
                      const std::vector<std::string>& methods) {
  if (contains(methods, entry.method))
    throw InputError(
        file, "\"{}\" is the name of another method as well; rename that one, or remove this file",
        entry.method);
}

}  // namespace

void write_entry(const fs::path& output, const Entry& entry) {
  fs::create_directories(output / "entries");
  write_whole_file(file_of(output, entry), json_lines(json(entry)));
}

const EnteredFarm* farm_of_other_truth(const Entry& entry, const SuiteResult& result) {
  for (const EnteredFarm& farm : entry.farms) {
    const auto place = farm_in(result.farms, farm);
    if (place == result.farms.end() || place->methods.empty()) continue;
    if (!is_same_truth(place->methods.front().score, farm.result.score)) return &farm;
  }
  return nullptr;
}

void require_entries(const fs::path& output, const std::vector<std::string>& methods) {
  for (const auto& [file, entry] : read_entries(output)) require_new_name(entry, file, methods);
}

void add_entries(const fs::path& output, SuiteResult& result, const std::optional<Entry>& added) {
  std::map<fs::path, Entry> entries = read_entries(output);
  if (added) entries.insert_or_assign(file_of(output, *added), *added);
  for (const auto& [file, entry] : entries) {
    require_new_name(entry, file, result.methods);
    if (const EnteredFarm* farm = farm_of_other_truth(entry, result))
      throw InputError(file,
                       "was scored against another truth than the results' of case {}; score the "
                       "submission again, or remove this file",
                       farm->case_name);
    bool shares_farms = false;
    for (const EnteredFarm& farm : entry.farms) {
      const auto place = farm_in(result.farms, farm);
      if (place == result.farms.end()) continue;
      place->methods.push_back(farm.result);
      shares_farms = true;
    }
    if (!shares_farms) continue;
    result.methods.push_back(entry.method);
    result.entered.push_back(entry.method);
  }
}

}  // namespace plotscan::farmbench
