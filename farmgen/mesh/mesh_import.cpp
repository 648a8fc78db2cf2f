// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh_import.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/core.h>

#include "core/bytes.h"
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

void put_lowest_at_zero(Mesh& mesh) {
  const auto below = [](const auto& a, const auto& b) { return a.z() < b.z(); };
  const float lowest = std::min_element(mesh.vertices.begin(), mesh.vertices.end(), below)->z();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.z() -= lowest;
}

std::string bytes_of(const Mesh& mesh, const std::vector<std::string>& notes) {
  ByteWriter bytes;
  put_mesh(bytes, mesh);
  bytes.put(static_cast<std::uint64_t>(notes.size()));
  for (const std::string& note : notes) bytes.put_text(note);
  return bytes.take();
}

// The mesh as a process of its own has read it.
Mesh read_apart(const std::filesystem::path& path, const std::string& extension,
                const MeshImportOptions& options, std::vector<std::string>* notes) {
  const std::string what = path.string() + ": cannot be read as a mesh";
  const IsolationLimits limits{.memory_bytes = kLeastMemory_bytes +
                                               kMemoryPerByte * std::filesystem::file_size(path)};
  const std::string received = run_isolated(what, limits, [&] {
    std::vector<std::string> own_notes;
    const Mesh mesh = read_with_assimp(path, extension, options, &own_notes);
    return bytes_of(mesh, own_notes);
  });
  try {
    ByteReader bytes(received);
    Mesh mesh = get_mesh(bytes);
    for (auto left = bytes.get<std::uint64_t>(); left > 0; --left) {
      const std::string note = bytes.get_text();
      if (notes != nullptr) notes->push_back(note);
    }
    return mesh;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(fmt::format("{}: its reader failed: {}", what, error.what()));
  }
}

}  // namespace

Mesh import_mesh(const std::filesystem::path& path, const MeshImportOptions& options,
                 std::vector<std::string>* notes) {
  require_file(path);
  const std::string extension = lower_extension(path);
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end())
    throw InputError(path, "is not a mesh format that is read: OBJ, DAE, glTF, GLB, PLY, STL");
  require_glb_length(path);
  Mesh mesh = read_apart(path, extension, options, notes);
  if (mesh.triangles.empty()) {
    throw InputError(path, "has no triangle with an area{}",
                     options.object.empty() ? "" : " in an object " + options.object);
  }
  if (options.foot == MeshFoot::lowest) put_lowest_at_zero(mesh);
  return mesh;
}

}  // namespace plotscan::mesh
