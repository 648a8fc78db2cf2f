// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace plotscan {

// The folder of the data that Plotscan ships: worlds/, models/, benchmarks/suites/. It is the one
// that the environment variable PLOTSCAN_DATA names; else share/plotscan of the nearest folder
// above the program or shared library that this code is part of, so that an installed tree may
// lie, and be moved, anywhere. A build tree has a link there to its sources. Throws InputError when
// PLOTSCAN_DATA names another kind of folder, and when there is none.
std::filesystem::path data_folder();

// A file as a user names it: itself where it exists, else what lies under that name in the data
// folder or in its `room` ("worlds"), with ".yaml" behind it or without. The name as it is where
// there is no such file, so that who opens it says so. Throws InputError when PLOTSCAN_DATA names
// another kind of folder.
std::filesystem::path found_file(const std::filesystem::path& name,
                                 const std::filesystem::path& room);

}  // namespace plotscan
