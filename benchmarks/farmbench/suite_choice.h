// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farmbench/suite.h"

namespace plotscan::farmbench {

// A suite, and which of its farms to use.
struct SuiteChoice {
  std::filesystem::path file;               // the YAML file
  std::optional<int> seeds = std::nullopt;  // the suite's first, and those after its highest
  // A file whose bytes are the secret of a blind contest. Seeds are drawn from it; their number is
  // the same as without it.
  std::optional<std::filesystem::path> secret = std::nullopt;
};

// The suite with the chosen seeds. Throws InputError as load_suite does, on a number of seeds out
// of range, and on a secret that is missing, shorter than 16 bytes or longer than 64 KiB.
Suite chosen_suite(const SuiteChoice& choice);

// One farm of a suite under the code that entrants know.
struct BlindField {
  std::string code;  // 10 hexadecimal digits, which tell neither case nor seed
  const SuiteCase& suite_case;
  std::uint64_t seed = 1;
};

// What a task says of a field's farm: equal farms of several fields must not show.
std::string blinded_farm_sha256(const std::string& code, const std::string& farm_sha256);

// Every farm of a chosen suite, which outlives them, in the order of their codes: each is the
// beginning of SHA-256 of the suite's and case's name, the seed and, where there is one, the
// secret.
std::vector<BlindField> blind_fields(const Suite& suite, const SuiteChoice& choice);

}  // namespace plotscan::farmbench
