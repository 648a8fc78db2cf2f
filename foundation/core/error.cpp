// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "core/internal/disk_error.h"
#include "core/temporary_path.h"

namespace plotscan {

InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : InputError(shown_path(file).string() + ": " + message) {}

InputError::InputError(const std::filesystem::path& file, std::size_t line,
                       const std::string& message)
    : InputError(shown_path(file).string() + ":" + std::to_string(line) + ": " + message) {}

namespace {

// The errno of what prevents writing to the file; 0: nothing does.
int obstacle(const std::filesystem::path& file) {
  const int opened = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (opened < 0) return errno;
  // More than what the file's last block may still have room for.
  const std::vector<char> bytes(std::size_t{1} << 17);
  int error = 0;
  for (std::size_t done = 0; error == 0 && done < bytes.size();) {
    const ssize_t written = ::write(opened, bytes.data(), bytes.size() - done);
    if (written < 0 && errno != EINTR) error = errno;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  ::close(opened);
  return error;
}

std::string write_message(const std::filesystem::path& file, int error) {
  const std::string name = shown_path(file).string();
  if (is_full(error)) return "no space left on " + name;
  return name + ": cannot be written" +
         (error != 0 ? ": " + std::generic_category().message(error) : "");
}

}  // namespace

WriteError::WriteError(const std::filesystem::path& file) : WriteError(file, obstacle(file)) {}

WriteError::WriteError(const std::filesystem::path& file, int error)
    : std::runtime_error(write_message(file, error)) {}

void throw_as_ours(const std::filesystem::filesystem_error& error) {
  const int reason = error.code().value();
  // What is copied or renamed comes first, and to where second.
  if (is_of_disk(reason))
    throw WriteError(error.path2().empty() ? error.path1() : error.path2(), reason);
  throw InputError(error.path1(), error.code().message());
}

void check(bool condition, const std::string& what) {
  if (!condition) throw std::logic_error("internal error: " + what);
}

void require_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(path, "no such file");
  if (std::filesystem::is_directory(path, error))
    throw InputError(path, "a folder, not a regular file");
  if (!std::filesystem::is_regular_file(path, error)) throw InputError(path, "not a regular file");
  if (!std::ifstream(path, std::ios::binary)) throw InputError(path, "cannot be read");
}

std::string read_text(const std::filesystem::path& path) {
  require_file(path);
  constexpr std::uintmax_t kMostBytes = 1'000'000'000;
  if (std::filesystem::file_size(path) > kMostBytes)
    throw InputError(path, "has more than 1 GB; as text it is read up to that");
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::filesystem::path path_inside(const std::filesystem::path& root,
                                  const std::filesystem::path& relative,
                                  const std::filesystem::path& source) {
  const std::filesystem::path normal = relative.lexically_normal();
  if (normal.empty() || normal.is_absolute() || *normal.begin() == "..")
    throw InputError(source, "path \"{}\" leaves its folder {}", relative.string(), root.string());
  return root / normal;
}

}  // namespace plotscan
