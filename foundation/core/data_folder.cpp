// SPDX-License-Identifier: Apache-2.0
#include "core/data_folder.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/core.h>

#include "core/error.h"
#include "core/text.h"

namespace plotscan {
namespace fs = std::filesystem;
namespace {

// Whether the folder is a data folder: one that has worlds/ and models/.
bool holds_data(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "worlds", ignored) &&
         fs::is_directory(folder / "models", ignored);
}

// The shared library that holds this code; if it is in none, the program.
fs::path own_file() {
  Dl_info info = {};
  const bool known = dladdr(reinterpret_cast<const void*>(&holds_data), &info) != 0;  // NOLINT
  const fs::path file = known && info.dli_fname != nullptr ? info.dli_fname : "";
  // For a program, dladdr gives the name it was started by, which PATH may have resolved.
  std::error_code ignored;
  return fs::canonical(file.is_absolute() ? file : "/proc/self/exe", ignored);
}

std::optional<fs::path> stated_folder() {
  const char* stated = std::getenv("PLOTSCAN_DATA");
  if (stated == nullptr || *stated == '\0') return std::nullopt;
  if (!holds_data(stated))
    throw InputError(stated, "named by PLOTSCAN_DATA, is not Plotscan's data: worlds and models");
  return stated;
}

std::optional<fs::path> installed_folder() {
  constexpr int kMostAbove = 4;  // python3/dist-packages/plotscan/ lies below lib/
  fs::path above = own_file().parent_path();
  for (int i = 0; i < kMostAbove && above.has_relative_path(); ++i) {
    if (holds_data(above / "share/plotscan")) return above / "share/plotscan";
    above = above.parent_path();
  }
  return std::nullopt;
}

// Where the program began, found before it runs: it may be replaced while it does.
const std::optional<fs::path> kInstalled = installed_folder();

std::optional<fs::path> known_folder() {
  if (auto stated = stated_folder()) return stated;
  return kInstalled;
}

// A name without a folder and an extension is meant as that of something shipped.
void require_no_mere_name(const fs::path& name, const fs::path& room) {
  std::error_code ignored;
  if (name.has_parent_path() || name.has_extension() || fs::exists(name, ignored)) return;
  std::vector<std::string> shipped;
  for (const auto& entry : fs::directory_iterator(room, ignored))
    if (entry.path().extension() == ".yaml") shipped.push_back(entry.path().stem().string());
  std::ranges::sort(shipped);
  if (!shipped.empty())
    throw InputError(name, "no such file, and none of the shipped ones: {}", joined(shipped, ", "));
}

}  // namespace

fs::path data_folder() {
  if (const auto folder = known_folder()) return *folder;
  throw InputError(
      fmt::format("Plotscan's data (worlds, models) lie nowhere near {}; set PLOTSCAN_DATA to "
                  "their folder, share/plotscan of the installation",
                  own_file().string()));
}

fs::path found_file(const fs::path& name, const fs::path& room) {
  std::error_code ignored;
  const bool is_file = fs::exists(name, ignored) && !fs::is_directory(name, ignored);
  const bool is_here = name.is_absolute() || name.native().starts_with(".");
  if (is_file || is_here) return name;
  const auto folder = known_folder();
  if (!folder) return name;
  for (const fs::path& place : {*folder, *folder / room}) {
    for (const char* extension : {"", ".yaml"}) {
      fs::path file = place / name;
      file += extension;
      if (fs::is_regular_file(file, ignored)) return file;
    }
  }
  return name;
}

fs::path found_place(const fs::path& name, const fs::path& room) {
  std::error_code ignored;
  return fs::is_directory(name, ignored) ? name : found_file(name, room);
}

fs::path found_or_shipped(const fs::path& name, const fs::path& room) {
  fs::path file = found_file(name, room);
  if (const auto folder = known_folder()) require_no_mere_name(file, *folder / room);
  return file;
}

}  // namespace plotscan
