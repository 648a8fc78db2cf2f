// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plotscan {

// The text of a file or an argument, made safe to print on a terminal: control characters, which
// could move its cursor or rename its window, and bytes that are no UTF-8 are written as "\x1b".
// Line ends and tabs stay.
std::string printable(std::string_view text);

// The text as it is where it is valid UTF-8; else taken for Latin-1 (ISO 8859-1), in UTF-8.
std::string utf8_of(const std::string& text);

// Throws InputError, naming the file and line, when the file's text is not valid UTF-8 (RFC 3629).
void require_utf8(std::string_view text, const std::filesystem::path& file);

}  // namespace plotscan
