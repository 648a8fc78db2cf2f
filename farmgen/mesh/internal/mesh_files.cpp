// SPDX-License-Identifier: Apache-2.0
#include "mesh/internal/mesh_files.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

#include <assimp/MemoryIOWrapper.h>

#include "core/error.h"
#include "core/text.h"
#include "mesh/internal/assimp_mesh.h"

namespace plotscan::mesh {
namespace fs = std::filesystem;
namespace {

bool is_gltf(const fs::path& mesh) {
  const std::string extension = mesh.extension().string();
  return extension.size() > 3 && (extension[1] == 'g' || extension[1] == 'G');  // .gltf, .glb
}

bool is_in_folder(const fs::path& file, const fs::path& folder) {
  const fs::path way = fs::absolute(file).lexically_normal().lexically_relative(
      fs::absolute(folder / ".").lexically_normal());
  return !way.empty() && *way.begin() != "..";
}

// The whole file as Assimp reads it rightly, in memory; nullptr where it can't be opened.
Assimp::IOStream* open_obj(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return nullptr;
  const std::string plain = plain_obj(std::string(std::istreambuf_iterator<char>(in), {}));
  auto bytes = std::make_unique<std::uint8_t[]>(plain.size());
  std::ranges::copy(plain, bytes.get());
  constexpr bool kOwned = true;
  return new Assimp::MemoryIOStream(bytes.release(), plain.size(), kOwned);
}

}  // namespace

MeshFiles::MeshFiles(fs::path mesh) : mesh_(std::move(mesh)), own_folder_only_(is_gltf(mesh_)) {}

Assimp::IOStream* MeshFiles::Open(const char* file, const char* mode) {
  const std::string objection = file == mesh_.string() ? "" : this->objection(file);
  if (objection.empty() && lower_extension(file) == ".obj") return open_obj(file);
  if (objection.empty()) return DefaultIOSystem::Open(file, mode);
  if (refused_.empty()) refused_ = "names " + std::string(file) + ", which " + objection;
  return nullptr;
}

std::string MeshFiles::objection(const fs::path& file) const {
  std::error_code error;
  if (own_folder_only_ && !is_in_folder(file, mesh_.parent_path())) return "leaves its folder";
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) return "is not a regular file";
  return "";
}

void require_glb_length(const fs::path& path) {
  std::array<char, 12> header{};  // "glTF", version, length; little-endian
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  if (std::string_view(header.data(), 4) != "glTF") return;
  std::uint32_t length = 0;
  std::memcpy(&length, header.data() + 8, sizeof length);
  if (length <= fs::file_size(path)) return;
  throw InputError(path, "promises {} bytes, but has {}", length, fs::file_size(path));
}

}  // namespace plotscan::mesh
