// SPDX-License-Identifier: Apache-2.0
// The fuzzers' files through their readers, without a fuzzer: seeds are read, and what the fuzzers
// once found is read or refused, in time.
#include <fstream>

#include "core/error.h"
#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "temporary_folder.h"

namespace plotscan::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

class FuzzTarget : public ::testing::TestWithParam<Target> {
 protected:
  bool is_read_here(const std::string& bytes) const {
    return is_read(GetParam(), bytes, folder_.path());
  }
  testing::TemporaryFolder folder_;
};

// Of files that are trees: YAML, JSON, XML.
class FuzzTree : public FuzzTarget {};

const fs::path kFuzz = fs::path(PLOTSCAN_SOURCE_DIR) / "tests/fuzz";

TEST_P(FuzzTarget, ReadsItsSeeds) {
  const auto seeds = files_below(kFuzz / "seeds" / GetParam().name);
  EXPECT_FALSE(seeds.empty());
  for (const fs::path& seed : seeds) EXPECT_TRUE(is_read_here(read_text(seed))) << seed;
}

TEST_P(FuzzTarget, RefusesOrReadsWhatWasFound) {
  for (const fs::path& file : files_below(kFuzz / "found" / GetParam().name)) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(is_read_here(read_text(file)));
  }
}

// Mutants of trees come past the parser: some of them are read.
TEST_P(FuzzTree, ReadsMutants) {
  const auto seeds = files_below(kFuzz / "seeds" / GetParam().name);
  const std::string bytes = read_text(seeds.front());
  int read = 0;
  int same = 0;
  constexpr int kMutants = 40;
  for (std::uint32_t i = 1; i <= kMutants; ++i) {
    const auto mutant = mutated(GetParam().structure, bytes, 7919 * i);
    ASSERT_TRUE(mutant);
    same += *mutant == mutated(GetParam().structure, bytes, 7919 * i) ? 1 : 0;
    read += is_read_here(*mutant) ? 1 : 0;
  }
  EXPECT_EQ(same, kMutants);
  EXPECT_GE(read, 2);
  EXPECT_LT(read, kMutants);
}

std::vector<Target> trees() {
  std::vector<Target> found = targets();
  std::erase_if(found, [](const Target& target) { return target.structure == Structure::bytes; });
  return found;
}

std::string name_of(const ::testing::TestParamInfo<Target>& tested) {
  std::string name = tested.param.name;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzTarget, ::testing::ValuesIn(targets()), name_of);
INSTANTIATE_TEST_SUITE_P(Readers, FuzzTree, ::testing::ValuesIn(trees()), name_of);

}  // namespace
}  // namespace plotscan::fuzz
