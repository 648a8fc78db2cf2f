// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_import.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <stdexcept>
#include <system_error>

#include <fmt/core.h>

#include "core/bytes.h"
#include "core/contains.h"
#include "core/error.h"
#include "core/isolated.h"
#include "core/text.h"
#include "mesh/internal/assimp_mesh.h"
#include "mesh/internal/mesh_bytes.h"
#include "mesh/internal/mesh_files.h"

namespace plotscan::mesh {
namespace {

constexpr std::array<const char*, 6> kFormats = {".obj", ".dae", ".gltf", ".glb", ".ply", ".stl"};

// Assimp takes up to some 40 bytes for one of a text file; what a file names besides (a glTF's
// buffers, images) has the rest.
constexpr std::uint64_t kLeastMemory_bytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kMemoryPerByte = 64;

constexpr std::uint64_t kReadAhead_bytes = std::uint64_t{4} << 20;

void put_lowest_at_zero(Mesh& mesh) {
  const auto below = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  const float lowest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(), below)->z();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.z() -= lowest;
}

Mesh read_checked(const MeshFile& file, std::vector<std::string>& notes) {
  const auto& [path, options] = file;
  require_file(path);
  const std::string extension = lower_extension(path);
  if (!contains(kFormats, extension))
    throw InputError(path, "is not a mesh format that is read: OBJ, DAE, glTF, GLB, PLY, STL");
  require_glb_length(path);
  Mesh mesh = read_with_assimp(path, extension, options, &notes);
  if (mesh.triangles.empty()) {
    throw InputError(path, "has no triangle with an area{}",
                     options.object.empty() ? "" : " in an object " + options.object);
  }
  if (options.foot == MeshFoot::lowest) put_lowest_at_zero(mesh);
  return mesh;
}

std::string bytes_of(std::span<const MeshFile> files) {
  ByteWriter bytes;
  for (const MeshFile& file : files) {
    std::vector<std::string> notes;
    put_mesh(bytes, read_checked(file, notes));
    bytes.put(static_cast<std::uint64_t>(notes.size()));
    for (const std::string& note : notes) bytes.put_text(note);
  }
  return bytes.take();
}

ImportedMesh get_imported(ByteReader& bytes) {
  ImportedMesh imported{.mesh = get_mesh(bytes), .notes = {}};
  for (auto left = bytes.get<std::uint64_t>(); left > 0; --left)
    imported.notes.push_back(bytes.get_text());
  return imported;
}

std::uint64_t size_of(const MeshFile& file) {
  std::error_code missing;
  const std::uintmax_t size = std::filesystem::file_size(file.path, missing);
  return missing ? 0 : size;
}

// The meshes as one process of its own has read them.
std::deque<ImportedMesh> read_apart(std::span<const MeshFile> files) {
  const std::string what = files.front().path.string() + ": cannot be read as a mesh";
  IsolationLimits limits{.memory_bytes = kLeastMemory_bytes};
  for (const MeshFile& file : files) limits.memory_bytes += kMemoryPerByte * size_of(file);
  const std::string received = run_isolated(what, limits, [&] { return bytes_of(files); });
  try {
    ByteReader bytes(received);
    std::deque<ImportedMesh> imported;
    while (imported.size() < files.size()) imported.push_back(get_imported(bytes));
    return imported;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: its reader failed: {}", what, error.what()));
  }
}

}  // namespace

Mesh import_mesh(const std::filesystem::path& path, const MeshImportOptions& options,
                 std::vector<std::string>* notes) {
  const MeshFile file{.path = path, .options = options};
  ImportedMesh imported = std::move(read_apart({&file, 1}).front());
  if (notes != nullptr) std::ranges::move(imported.notes, std::back_inserter(*notes));
  return std::move(imported.mesh);
}

// Where one of them cannot be read each is read alone, at its turn.
void MeshReader::read_ahead() {
  std::uint64_t bytes = 0;
  while (tried_ < files_.size() && (bytes += size_of(files_[tried_])) <= kReadAhead_bytes) ++tried_;
  const auto together = std::span(files_).subspan(taken_, tried_ - taken_);
  if (together.size() < 2) return;
  try {
    read_ = read_apart(together);
  } catch (const InputError&) {
  }
}

ImportedMesh MeshReader::next() {
  if (taken_ >= tried_) read_ahead();
  const MeshFile& file = files_.at(taken_++);
  tried_ = std::max(tried_, taken_);
  if (read_.empty()) read_ = read_apart({&file, 1});
  ImportedMesh imported = std::move(read_.front());
  read_.pop_front();
  return imported;
}

}  // namespace plotscan::mesh
