// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farmbench/farm_result.h"
#include "farmbench/suite_result.h"

// Scores of submissions in a results folder: entries/METHOD.json (docs/submissions.md).
namespace plotscan::farmbench {

// One farm of a submission, scored, and the hashes that say what it was made from.
struct EnteredFarm {
  std::string case_name;
  std::uint64_t seed = 0;
  std::string field;         // its code
  std::string farm_sha256;   // of its truth
  std::string cloud_sha256;  // as the submission's task.json has it, "" without one
  std::string file_sha256;   // of what was handed in, "" where nothing was
  MethodResult result;
};

struct Entry {
  std::string method;  // its rows' name in tables
  std::string suite;
  std::string program_sha256;  // of the entrant's program, as stated; "" where it is not
  std::string scorer_sha256;   // of the program that scored
  std::vector<EnteredFarm> farms;
};

// Writes output/entries/METHOD.json.
void write_entry(const std::filesystem::path& output, const Entry& entry);

// The first farm of the entry that has another truth in the result, none where all have the same.
const EnteredFarm* farm_of_other_truth(const Entry& entry, const SuiteResult& result);

// Throws InputError on a broken entry of a results folder, and on one whose name is one of
// `methods`: to be called before the hours that a run takes.
void require_entries(const std::filesystem::path& output, const std::vector<std::string>& methods);

// Adds the entries of a results folder, by name, to the result's methods, for the farms that both
// have; entries that share no farm are left out. `added` counts as if it were there already, in
// place of an earlier one of its name. Throws InputError as require_entries, and on an entry that
// was scored against another truth.
void add_entries(const std::filesystem::path& output, SuiteResult& result,
                 const std::optional<Entry>& added = {});

}  // namespace plotscan::farmbench
