// SPDX-License-Identifier: Apache-2.0
#include "farmfolder/terrain_ply.h"

#include <bit>
#include <cstring>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "core/text_file.h"

namespace plotscan::farmfolder {
namespace {

static_assert(std::endian::native == std::endian::little, "terrain.ply is written as it lies");

constexpr std::size_t kVertexBytes = 3 * sizeof(double);
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::uint32_t);

std::string header(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, x east, y north, z up\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      vertices, faces);
}

// The count in the line "element NAME COUNT"; the line's own text is checked by comparing the whole
// header afterwards.
std::size_t element_count(const std::string& text, const std::string& element) {
  const std::string key = "\nelement " + element + " ";
  const auto place = text.find(key);
  std::size_t count = 0;
  if (place != std::string::npos) std::istringstream(text.substr(place + key.size(), 20)) >> count;
  return count;
}

}  // namespace

void write_terrain(const std::filesystem::path& path, const terrain::Terrain& terrain) {
  std::string data = header(terrain.vertices().size(), terrain.triangles().size());
  for (const Eigen::Vector3d& vertex : terrain.vertices())
    data.append(reinterpret_cast<const char*>(vertex.data()), kVertexBytes);
  for (const auto& triangle : terrain.triangles()) {
    data += '\3';
    data.append(reinterpret_cast<const char*>(triangle.data()), kFaceBytes - 1);
  }
  write_text_file(path, data);
}

terrain::Terrain read_terrain(const std::filesystem::path& path) {
  const std::string data = read_text(path);
  const std::size_t vertex_count = element_count(data, "vertex");
  const std::size_t face_count = element_count(data, "face");
  const std::string expected = header(vertex_count, face_count);
  if (!data.starts_with(expected))
    throw InputError(path, "is not a terrain written by farmgen (its PLY header is another)");
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  const bool countable = vertex_count <= kMost && face_count <= kMost;
  const std::size_t size = expected.size() + vertex_count * kVertexBytes + face_count * kFaceBytes;
  if (!countable || data.size() != size) {
    throw InputError(path, "has {} bytes; its header, with {} vertices and {} faces, makes {}",
                     data.size(), vertex_count, face_count, size);
  }
  const char* next = data.data() + expected.size();
  std::vector<Eigen::Vector3d> vertices(vertex_count);
  for (Eigen::Vector3d& vertex : vertices) {
    std::memcpy(vertex.data(), next, kVertexBytes);
    next += kVertexBytes;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles(face_count);
  for (auto& triangle : triangles) {
    if (*next != '\3') throw InputError(path, "has a face that is no triangle");
    std::memcpy(triangle.data(), next + 1, kFaceBytes - 1);
    next += kFaceBytes;
  }
  try {
    return {std::move(vertices), std::move(triangles)};
  } catch (const InputError& error) {
    throw InputError(path, error.what());
  }
}

}  // namespace plotscan::farmfolder
