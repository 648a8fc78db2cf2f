// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// The folder of the data that Plotscan ships: worlds/, models/, benchmarks/suites/. It is the
// folder that the environment variable PLOTSCAN_DATA names. Without that, share/plotscan is looked
// for in the folders above the program or shared library that holds this code, the nearest first:
// an installed tree may be moved anywhere. In a build tree, share/plotscan links to the sources.
// Throws InputError when PLOTSCAN_DATA names another kind of folder, and when there is none.
std::filesystem::path data_folder();

// The file that a user names: `name` itself if it exists and is no folder (results are often in one
// named as the suite), is absolute or begins with a dot; else the file of that name, with or
// without
// ".yaml" added, in the data folder or its subfolder `room` ("worlds"). Returns `name` unchanged if
// there is no such file: opening it then fails with a message. Throws InputError when PLOTSCAN_DATA
// names another kind of folder.
std::filesystem::path found_file(const std::filesystem::path& name,
                                 const std::filesystem::path& room);

// The same where a folder, such as a farm, may be meant as well.
std::filesystem::path found_place(const std::filesystem::path& name,
                                  const std::filesystem::path& room);

// As found_file, for names of what `room` ships. Throws InputError, naming these, on one that is
// none.
std::filesystem::path found_or_shipped(const std::filesystem::path& name,
                                       const std::filesystem::path& room);

}  // namespace plotscan
