// SPDX-License-Identifier: Apache-2.0
#include "farm/obj.h"

#include "farm/text_file.h"

namespace plotscan::farm {
namespace {

void write(const std::filesystem::path& path, const Mesh& mesh, const std::string& material) {
  TextFile out(path);
  out << "# metres, z up\n" << material;
  for (const Eigen::Vector3f& v : mesh.vertices) {
    out << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  }
  for (const auto& triangle : mesh.triangles) {
    out << "f " << triangle[0] + 1 << " " << triangle[1] + 1 << " " << triangle[2] + 1 << "\n";
  }
  out.close();
}

}  // namespace

void write_obj(const std::filesystem::path& path, const Mesh& mesh) { write(path, mesh, ""); }

void write_coloured_obj(const std::filesystem::path& path, const Mesh& mesh,
                        const Eigen::Vector3f& colour) {
  const std::filesystem::path material = std::filesystem::path(path).replace_extension(".mtl");
  TextFile out(material);
  out << "newmtl surface\nKa " << colour.x() << " " << colour.y() << " " << colour.z() << "\nKd "
      << colour.x() << " " << colour.y() << " " << colour.z() << "\nKs 0 0 0\n";
  out.close();
  write(path, mesh, "mtllib " + material.filename().string() + "\nusemtl surface\n");
}

}  // namespace plotscan::farm
