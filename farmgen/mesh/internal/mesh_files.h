// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <assimp/DefaultIOSystem.h>

// Holds Assimp's types.
namespace plotscan::mesh {

// The files that Assimp may open for a mesh: the mesh's own and regular files that it names. For
// glTF only those in its own folder, as buffers lie nowhere else.
class MeshFiles : public Assimp::DefaultIOSystem {
 public:
  explicit MeshFiles(std::filesystem::path mesh);

  Assimp::IOStream* Open(const char* file, const char* mode) override;

  // Why a file was not opened that the mesh names; empty: none was refused.
  const std::string& refused() const { return refused_; }

 private:
  std::string objection(const std::filesystem::path& file) const;

  std::filesystem::path mesh_;
  bool own_folder_only_;
  std::string refused_;
};

// Throws InputError when a GLB's header promises more bytes than the file has: Assimp would
// allocate them first.
void require_glb_length(const std::filesystem::path& path);

}  // namespace plotscan::mesh
