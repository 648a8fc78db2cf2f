// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

namespace plotscan {

// Bad input: a file, a line of it, a value, an argument. The message says which one, what is wrong
// and what would be right. Programs catch it once, print the message and end with exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  // "file: message"; a file that is still being written is called by its final name
  InputError(const std::filesystem::path& file, const std::string& message);
  // "file:line: message", lines counted from 1
  InputError(const std::filesystem::path& file, std::size_t line, const std::string& message);
  // The same with a message that holds arguments: "has {} fields".
  template <class... Arguments>
  InputError(const std::filesystem::path& file, fmt::format_string<Arguments...> message,
             Arguments&&... arguments)
      : InputError(file, fmt::vformat(message, fmt::make_format_args(arguments...))) {}
  template <class... Arguments>
  InputError(const std::filesystem::path& file, std::size_t line,
             fmt::format_string<Arguments...> message, Arguments&&... arguments)
      : InputError(file, line, fmt::vformat(message, fmt::make_format_args(arguments...))) {}
};

// The input is sound, but nothing that is to be measured can be seen in it. The message says why,
// and what to do next. Programs end with exit code 3.
class NothingToMeasure : public InputError {
 public:
  using InputError::InputError;
};

// Output that cannot be written: "no space left on FILE", or "FILE: cannot be written" with the
// reason; FILE is named as in InputError. Programs end with exit code 1.
class WriteError : public std::runtime_error {
 public:
  // Finds the reason by writing to the file once more, which is lost anyway.
  explicit WriteError(const std::filesystem::path& file);
  // `error` is a value of errno.
  WriteError(const std::filesystem::path& file, int error);
};

// Throws a std::filesystem error again as one of ours: WriteError where the disk is full, read only
// or broken, else InputError, "FILE: reason".
[[noreturn]] void throw_as_ours(const std::filesystem::filesystem_error& error);

// Throws std::logic_error with the text `what` unless the condition holds: a bug in Plotscan, never
// the user's fault.
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
