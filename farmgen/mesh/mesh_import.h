// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace plotscan::mesh {

enum class UpAxis { z, y };
enum class MeshFoot {
  origin,  // the file's origin is the stem's base
  lowest,  // the mesh is moved along z until its lowest vertex is at 0
};

// How a file's coordinates become metres with z up.
struct MeshImportOptions {
  // Absent: what the file states (DAE, glTF: the format fixes it), else z up (OBJ, PLY, STL).
  std::optional<UpAxis> up = {};
  // Metres a unit of the file; for DAE and glTF, which state their unit, a further factor.
  double unit_m = 1;
  MeshFoot foot = MeshFoot::origin;
  std::string object = {};  // reads the file's object of this name alone; empty: all

  bool operator==(const MeshImportOptions&) const = default;
};

// Reads a triangle mesh from an OBJ, DAE, glTF (.gltf, .glb), PLY or STL file. Polygons are
// triangulated, all objects joined, equal vertices shared, and triangles without area dropped.
// Materials keep their names, diffuse colours and textures (PNG or JPEG, inside the file or beside
// it), what write_mtl says of them, and where they let rays through: `map_d` and other opacity
// textures, else the texture's own alpha (of glTF as alphaMode and alphaCutoff say). `notes`, where
// given, gains a line for each opacity texture that is left out since it is absent or in another
// format. Throws InputError when the file is missing or cannot be parsed, its format is another, a
// coordinate is not finite, it has no such object, no triangle with an area is left, or an image
// with an alpha is broken or too large.
Mesh import_mesh(const std::filesystem::path& path, const MeshImportOptions& options = {},
                 std::vector<std::string>* notes = nullptr);

struct MeshFile {
  std::filesystem::path path;
  MeshImportOptions options = {};
};

struct ImportedMesh {
  Mesh mesh;
  std::vector<std::string> notes;
};

// Reads files one after the other as import_mesh reads each. Small ones are read together ahead of
// their turns: a process of its own for each file takes longer than the file.
class MeshReader {
 public:
  explicit MeshReader(std::vector<MeshFile> files) : files_(std::move(files)) {}

  // The next file's. Throws InputError as import_mesh does for it.
  ImportedMesh next();

 private:
  void read_ahead();

  std::vector<MeshFile> files_;
  std::size_t taken_ = 0;          // of `files_`
  std::size_t tried_ = 0;          // of `files_`, those that were read ahead or could not be
  std::deque<ImportedMesh> read_;  // from `taken_` on
};

}  // namespace plotscan::mesh
