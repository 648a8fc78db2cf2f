// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Private to the library.
namespace plotscan::mesh {

// The text of an OBJ file without what Assimp reads wrongly, though OBJ has it: it takes ".5" for
// no number, and leaves the vertex out, so that faces have other corners; and it refuses a comment
// behind a face. Numbers of vertices get their leading zero, and comments behind vertices and faces
// go; lines stay where they are.
std::string plain_obj(std::string_view text);

}  // namespace plotscan::mesh
