// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

#include <system_error>

#include <gmock/gmock.h>

#include "temporary_folder.h"

namespace plotscan {
namespace {

TEST(InputError, NamesFileAndLine) {
  EXPECT_STREQ(InputError("farm.yaml", 7, "bad").what(), "farm.yaml:7: bad");
}

TEST(PathInside, RefusesToLeaveItsFolder) {
  EXPECT_EQ(path_inside("farm", "models/a/../b", "x"), "farm/models/b");
  EXPECT_THROW(path_inside("farm", "../secret", "x"), InputError);
  EXPECT_THROW(path_inside("farm", "models/../../secret", "x"), InputError);
  EXPECT_THROW(path_inside("farm", "/etc/passwd", "x"), InputError);
  EXPECT_THROW(path_inside("farm", "", "x"), InputError);
}

TEST(ReadText, RefusesMissingFilesAndFolders) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(read_text(folder.write("a.txt", "line\n")), "line\n");
  EXPECT_THROW(read_text(folder.path() / "absent"), InputError);
  EXPECT_THROW(read_text(folder.path()), InputError);
}

// A full disk is nobody's bad input.
TEST(ThrowAsOurs, TellsDisksFromInput) {
  const auto thrown = [](std::errc reason) {
    throw_as_ours({"", "out/file", std::make_error_code(reason)});
  };
  EXPECT_EQ(testing::message_of<WriteError>([&] { thrown(std::errc::no_space_on_device); }),
            "no space left on out/file");
  EXPECT_THAT(testing::message_of<WriteError>([&] { thrown(std::errc::read_only_file_system); }),
              ::testing::HasSubstr("out/file: cannot be written"));
  const std::filesystem::filesystem_error copy("", "in/file", "out/file",
                                               std::make_error_code(std::errc::no_space_on_device));
  EXPECT_EQ(testing::message_of<WriteError>([&] { throw_as_ours(copy); }),
            "no space left on out/file");
  EXPECT_EQ(testing::message_of<InputError>([&] { thrown(std::errc::permission_denied); }),
            "out/file: Permission denied");
}

TEST(Check, ThrowsWhenFalse) {
  EXPECT_NO_THROW(check(true, "fine"));
  EXPECT_THROW(check(false, "broken"), std::logic_error);
}

TEST(ReadText, RefusesWhatIsTooLargeToHold) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("f.csv", "x");
  std::filesystem::resize_file(file, 1'000'000'001);
  EXPECT_EQ(testing::message_of<InputError>([&] { read_text(file); }),
            file.string() + ": has more than 1 GB; as text it is read up to that");
}

}  // namespace
}  // namespace plotscan
