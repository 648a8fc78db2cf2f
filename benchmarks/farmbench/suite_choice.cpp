// SPDX-License-Identifier: Apache-2.0
#include "farmbench/suite_choice.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/list_of.h"
#include "farmbench/entry/sha256.h"

namespace plotscan::farmbench {
namespace {

constexpr std::size_t kLeastSecret = 16;
constexpr std::size_t kMostSecret = 65'536;
constexpr std::size_t kCodeDigits = 10;
constexpr std::size_t kSeedDigits = 13;  // 52 bits, which every reader of JSON keeps

// Without the line end that an editor leaves.
std::string read_secret(const std::filesystem::path& file) {
  std::string secret = read_text(file);
  while (!secret.empty() && (secret.back() == '\n' || secret.back() == '\r')) secret.pop_back();
  if (secret.size() < kLeastSecret || secret.size() > kMostSecret) {
    throw InputError(
        file,
        "holds {} bytes; a secret has 16 to 65536, such as head -c 32 /dev/urandom | base64 writes",
        secret.size());
  }
  return secret;
}

std::string secret_of(const SuiteChoice& choice) {
  return choice.secret ? read_secret(*choice.secret) : "";
}

// The parts cannot run into each other: names hold no line ends, and the secret comes last.
std::string digits_of(const char* what, const std::string& suite, const std::string& name,
                      std::uint64_t number, const std::string& secret) {
  return sha256_of(std::string("plotscan ") + what + "\n" + suite + "\n" + name + "\n" +
                   std::to_string(number) + "\n" + secret);
}

// The suite's first seeds; where it has fewer, the numbers after its highest one follow.
void take_seeds(std::size_t count, std::vector<std::uint64_t>& seeds) {
  std::uint64_t highest = *std::ranges::max_element(seeds);
  while (seeds.size() < count) seeds.push_back(++highest);
  seeds.resize(count);
}

std::uint64_t drawn_seed(const std::string& suite, std::size_t index, const std::string& secret) {
  return std::stoull(digits_of("seed", suite, "", index, secret).substr(0, kSeedDigits), nullptr,
                     16);
}

}  // namespace

Suite chosen_suite(const SuiteChoice& choice) {
  if (choice.seeds && (*choice.seeds < 1 || *choice.seeds > kMostSeeds))
    throw InputError("the number of seeds is " + std::to_string(*choice.seeds) +
                     "; it is 1 to 10000");
  Suite suite = load_suite(choice.file);
  if (choice.seeds) take_seeds(static_cast<std::size_t>(*choice.seeds), suite.seeds);
  if (!choice.secret) return suite;
  const std::string secret = secret_of(choice);
  for (std::size_t i = 0; i < suite.seeds.size(); ++i)
    suite.seeds[i] = drawn_seed(suite.name, i, secret);
  return suite;
}

std::vector<BlindField> blind_fields(const Suite& suite, const SuiteChoice& choice) {
  const std::string secret = secret_of(choice);
  std::map<std::string, BlindField> by_code;
  for (const SuiteCase& suite_case : suite.cases) {
    for (const std::uint64_t seed : suite.seeds) {
      const std::string code =
          digits_of("field", suite.name, suite_case.name, seed, secret).substr(0, kCodeDigits);
      const bool is_new = by_code.try_emplace(code, BlindField{code, suite_case, seed}).second;
      check(is_new, "no two fields have one code");
    }
  }
  return list_of(by_code, [](const auto& entry) { return entry.second; });
}

std::string blinded_farm_sha256(const std::string& code, const std::string& farm_sha256) {
  return sha256_of(code + farm_sha256);
}

}  // namespace plotscan::farmbench
