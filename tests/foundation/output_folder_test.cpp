// SPDX-License-Identifier: Apache-2.0
#include "core/output_folder.h"

#include <cerrno>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "core/output_file.h"
#include "temporary_folder.h"

namespace plotscan {
namespace {
namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, AppearsOnlyWhenCommitted) {
  const testing::TemporaryFolder folder;
  {
    const OutputFolder abandoned(folder.path() / "out", false, "farmgen generate");
    std::ofstream(abandoned.path() / "file") << "x";
  }
  EXPECT_EQ(entries(folder.path()), 0u);
  OutputFolder kept(folder.path() / "deep" / "out/", false, "farmgen generate");
  std::ofstream(kept.path() / "file") << "x";
  EXPECT_FALSE(fs::exists(folder.path() / "deep/out"));
  kept.commit();
  EXPECT_TRUE(fs::exists(folder.path() / "deep/out/file"));
  EXPECT_EQ(entries(folder.path() / "deep"), 1u);
}

constexpr const char* kManifest = R"({"plotscan": "0.1.0", "command": "farmgen generate"})";

TEST(OutputFolder, NeverReplacesWhatIsNotOurs) {
  const testing::TemporaryFolder folder;
  const auto refused = [](const fs::path& path, bool replace, const std::string& command) {
    EXPECT_THROW(OutputFolder(path, replace, command), InputError) << path;
  };
  folder.write("foreign/data", "precious");
  folder.write("web/manifest.json", "{}");
  folder.write("broken/manifest.json", "[]");
  folder.write("ours/manifest.json", kManifest);
  refused(folder.path() / "foreign", true, "farmgen generate");
  refused(folder.path() / "web", true, "farmgen generate");
  refused(folder.path() / "broken", true, "farmgen generate");
  refused(folder.write("file", ""), true, "farmgen generate");
  refused(folder.path() / "ours", false, "farmgen generate");
  refused(folder.path() / "ours", true, "lidarsim fly");
  refused("", true, "farmgen generate");
  EXPECT_TRUE(fs::exists(folder.path() / "foreign/data"));
  EXPECT_TRUE(fs::exists(folder.path() / "web/manifest.json"));
}

TEST(OutputFolder, ReplacesItsOwnWhenCommitted) {
  const testing::TemporaryFolder folder;
  folder.write("ours/manifest.json", kManifest);
  {
    OutputFolder replaced(folder.path() / "ours", true, "farmgen generate");
    std::ofstream(replaced.path() / "new") << "x";
    EXPECT_TRUE(fs::exists(folder.path() / "ours/manifest.json"));
    replaced.commit();
  }
  EXPECT_FALSE(fs::exists(folder.path() / "ours/manifest.json"));
  EXPECT_TRUE(fs::exists(folder.path() / "ours/new"));
  EXPECT_EQ(entries(folder.path()), 1u);
}

// A link is written through: the folder that it leads to is the output, as for a copy.
TEST(OutputFolder, LiesWhereALinkLeads) {
  const testing::TemporaryFolder folder;
  folder.write("disk/ours/manifest.json", kManifest);
  fs::create_directory_symlink(folder.path() / "disk/ours", folder.path() / "link");
  OutputFolder replaced(folder.path() / "link", true, "farmgen generate");
  std::ofstream(replaced.path() / "new") << "x";
  replaced.commit();
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
  EXPECT_TRUE(fs::exists(folder.path() / "disk/ours/new"));
  EXPECT_FALSE(fs::exists(folder.path() / "disk/ours/manifest.json"));
}

TEST(OutputFile, LiesWhereALinkLeads) {
  const testing::TemporaryFolder folder;
  folder.write("disk/cloud.pcd", "old");
  fs::create_symlink(folder.path() / "disk/cloud.pcd", folder.path() / "link.pcd");
  OutputFile file(folder.path() / "link.pcd", true);
  std::ofstream(file.path()) << "new";
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder.path() / "link.pcd"));
  EXPECT_EQ(read_text(folder.path() / "disk/cloud.pcd"), "new");
}

std::string with_outputs(const std::string& outputs) {
  return R"({"plotscan": "0.1.0", "command": "farmgen generate", "outputs": [)" + outputs + "]}";
}

TEST(OutputFolder, IsNotReplacedWithFilesOfOthersInIt) {
  const testing::TemporaryFolder folder;
  folder.write("ours/manifest.json", with_outputs(R"({"file": "truth/plots.csv", "hash": ""})"));
  folder.write("ours/truth/plots.csv", "of the command");
  const auto replace = [&] {
    OutputFolder replaced(folder.path() / "ours", true, "farmgen generate");
    std::ofstream(replaced.path() / "new") << "x";
    replaced.commit();
  };
  for (const std::string stranger :
       {"notes.txt", "truth/notes.txt", ".git/config", "scan/cloud.pcd", "scan/manifest.json"}) {
    const auto file = folder.write("ours/" + stranger, "precious");
    EXPECT_THAT(testing::message_of<InputError>(replace), ::testing::HasSubstr(stranger));
    EXPECT_EQ(read_text(file), "precious");
    EXPECT_EQ(entries(folder.path()), 1u);
    fs::remove(file);
  }
  fs::create_symlink("/", folder.path() / "ours/link");
  EXPECT_THAT(testing::message_of<InputError>(replace), ::testing::HasSubstr("link"));
  fs::remove(folder.path() / "ours/link");
  replace();
  EXPECT_EQ(entries(folder.path() / "ours"), 1u);
}

TEST(OutputFolder, KeepsWhatCameWhileItWasWritten) {
  const testing::TemporaryFolder folder;
  folder.write("ours/manifest.json", kManifest);
  {
    OutputFolder replaced(folder.path() / "ours", true, "farmgen generate");
    folder.write("ours/notes.txt", "precious");
    EXPECT_THROW(replaced.commit(), InputError);
  }
  EXPECT_EQ(read_text(folder.path() / "ours/notes.txt"), "precious");
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(OutputFolder, LiesApartFromItsInputs) {
  const testing::TemporaryFolder folder;
  const fs::path farm = folder.write("data/field/manifest.json", kManifest).parent_path();
  fs::create_symlink(farm, folder.path() / "link");
  const std::vector<fs::path> inputs = {farm / "manifest.json"};
  const auto make = [&](const fs::path& out) {
    const OutputFolder made(out, true, "farmgen generate", inputs);
  };
  for (const fs::path& out :
       {farm, farm / "scan", farm / "a/b", farm / "../field/scan", farm.parent_path(),
        folder.path() / "link/scan", folder.path() / "link"}) {
    EXPECT_THROW(make(out), InputError) << out;
  }
  EXPECT_NO_THROW(make(farm.parent_path() / "farm2"));
  EXPECT_NO_THROW(make(farm.parent_path() / "scan"));
  EXPECT_EQ(entries(farm), 1u);
}

TEST(TemporaryPath, IsRemovedWithItsObjectOrAtOnce) {
  const testing::TemporaryFolder folder;
  { const TemporaryPath kept_short(folder.write("a/file", "x").parent_path()); }
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
  const TemporaryPath living(folder.write("b/file", "x").parent_path());
  static bool halted = false;
  TemporaryPath::remove_all([] { halted = true; });
  EXPECT_TRUE(halted);
  EXPECT_FALSE(fs::exists(folder.path() / "b"));
}

// The number of a process that has ended.
pid_t gone_process() {
  const pid_t process = fork();
  if (process == 0) _exit(0);
  waitpid(process, nullptr, 0);
  return process;
}

TEST(TemporaryPath, SweepsWhatAKilledRunLeft) {
  const testing::TemporaryFolder folder;
  const std::string gone = std::to_string(gone_process());
  const auto left = folder.write(".out.partial-" + gone + "/truth/plots.csv", "x");
  fs::create_symlink("/nowhere", left.parent_path() / "link");
  folder.write(".other.partial-" + gone, "x");
  folder.write(".out.partial-" + std::to_string(getppid()), "x");
  folder.write(".out.partial-" + gone + "x", "x");
  folder.write("out.partial-" + gone, "x");
  { const OutputFolder output(folder.path() / "out", false, "farmgen generate"); }
  EXPECT_FALSE(fs::exists(left.parent_path().parent_path()));
  EXPECT_EQ(entries(folder.path()), 4u) << "what is another's, or a living process', stays";
  folder.write(".cloud.partial-" + gone + ".las", "x");
  { const OutputFile file(folder.path() / "cloud.las", true); }
  EXPECT_EQ(entries(folder.path()), 4u);
}

TEST(TemporaryPath, SweepsWhatAProcessLeftThatNobodyHasAskedAfter) {
  const testing::TemporaryFolder folder;
  const pid_t process = fork();
  if (process == 0) _exit(0);
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT), 0);
  folder.write(".out.partial-" + std::to_string(process), "x");
  { const OutputFolder output(folder.path() / "out", false, "farmgen generate"); }
  EXPECT_EQ(entries(folder.path()), 0u);
  waitpid(process, nullptr, 0);
}

TEST(TemporaryPath, ErrorsNameTheFileThatItBecomes) {
  const testing::TemporaryFolder folder;
  const OutputFile file(folder.path() / "cloud.las", false);
  const OutputFolder scan(folder.path() / "scan.1", false, "lidarsim fly");
  const auto named = [&](const fs::path& path) { return (folder.path() / path).string(); };
  EXPECT_EQ(InputError(file.path(), "is broken").what(), named("cloud.las") + ": is broken");
  EXPECT_EQ(InputError(scan.path() / "poses.csv", 3, "is broken").what(),
            named("scan.1/poses.csv") + ":3: is broken");
  EXPECT_EQ(WriteError(scan.path(), ENOSPC).what(), "no space left on " + named("scan.1"));
  const std::string own = ".partial-" + std::to_string(getpid());
  for (const std::string& other : {"a/" + own, ".cloud" + own + "0.las", "cloud" + own + ".las"})
    EXPECT_EQ(shown_path(other), other);
}

TEST(OutputFile, AppearsWholeOrNotAtAll) {
  const testing::TemporaryFolder folder;
  const auto final_path = folder.path() / "cloud.las";
  const auto write = [&](bool commit, const std::string& text) {
    OutputFile file(final_path, true);
    EXPECT_EQ(file.path().extension(), ".las");
    std::ofstream(file.path()) << text;
    if (commit) file.commit();
  };
  write(false, "half");
  EXPECT_EQ(entries(folder.path()), 0u);
  write(true, "whole");
  write(false, "half");
  EXPECT_EQ(read_text(final_path), "whole");
  EXPECT_EQ(entries(folder.path()), 1u);
  EXPECT_THROW(OutputFile(final_path, false), InputError);
  EXPECT_THROW(OutputFile(folder.path(), true), InputError);
  EXPECT_THROW(OutputFile(folder.path() / "none" / "cloud.las", false), InputError);
}

}  // namespace
}  // namespace plotscan
