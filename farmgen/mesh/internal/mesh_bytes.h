// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/bytes.h"
#include "mesh/mesh.h"

namespace plotscan::mesh {

// A mesh as bytes, for another process of the same program.
void put_mesh(ByteWriter& bytes, const Mesh& mesh);

// The mesh back. Throws std::runtime_error where the bytes are no sound mesh: an index beyond its
// list, a number that is not finite.
Mesh get_mesh(ByteReader& bytes);

}  // namespace plotscan::mesh
