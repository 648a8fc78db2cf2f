// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace plotscan {

// Bad input: a file, a line of it, a value, an argument. The message says which one, what is wrong
// and what would be right. Programs catch it once, print the message and end with exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  // "file: message"; of a file that is being written, the name that it will have
  InputError(const std::filesystem::path& file, const std::string& message);
  // "file:line: message", lines counted from 1
  InputError(const std::filesystem::path& file, std::size_t line, const std::string& message);
};

// Input that is sound and shows nothing of what is to be measured. The message says why, and what
// to do next. Programs end with exit code 3.
class NothingToMeasure : public InputError {
 public:
  using InputError::InputError;
};

// Output that cannot be written: "no space left on FILE", or "FILE: cannot be written" with the
// reason; FILE as in InputError. Programs end with exit code 1.
class WriteError : public std::runtime_error {
 public:
  // Finds the reason by writing once more; the file is lost anyway.
  explicit WriteError(const std::filesystem::path& file);
  // `error` as in errno.
  WriteError(const std::filesystem::path& file, int error);
};

// Throws an error of the file system as one of these: WriteError where the disk is full, read only
// or broken, else InputError, "FILE: reason".
[[noreturn]] void throw_as_ours(const std::filesystem::filesystem_error& error);

// Throws std::logic_error with the text: a bug in Plotscan, never the user's fault.
void check(bool condition, const std::string& what);

// Opens nothing; throws InputError when the path is not a readable regular file.
void require_file(const std::filesystem::path& path);

// The whole file as text. Throws InputError when it cannot be read.
std::string read_text(const std::filesystem::path& path);

// root / relative, or InputError (naming `source`) when `relative` is absolute or leaves root.
std::filesystem::path path_inside(const std::filesystem::path& root,
                                  const std::filesystem::path& relative,
                                  const std::filesystem::path& source);

}  // namespace plotscan
