// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plotscan::farmbench {

// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, as `sha256sum` prints it.
std::string sha256_of(std::string_view bytes);
// SHA-256 of a file's bytes. Throws InputError when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

// SHA-256 of the lines that `LC_ALL=C sha256sum *` prints inside the folder: one hash for all its
// files.
std::string sha256_of_folder(const std::filesystem::path& folder);

}  // namespace plotscan::farmbench
