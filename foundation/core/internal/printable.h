// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plotscan {

// Text of a file or an argument as a terminal may be given it: control characters, which could move
// its cursor or rename its window, and bytes that are no UTF-8 stand as "\\x1b". Line ends and tabs
// stay.
std::string printable(std::string_view text);

// Throws InputError, naming the file and line, where a byte of the file's text is no UTF-8
// (RFC 3629).
void require_utf8(std::string_view text, const std::filesystem::path& file);

}  // namespace plotscan
