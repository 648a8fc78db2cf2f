// SPDX-License-Identifier: Apache-2.0
#include "mesh/mesh.h"

#include "mesh/alpha_mask.h"

namespace plotscan::mesh {
namespace {

using ImagePointer = std::shared_ptr<const Image>;

bool same(const ImagePointer& a, const ImagePointer& b) {
  if (a == nullptr || b == nullptr) return a == b;
  return a == b || (a->name == b->name && a->bytes == b->bytes);
}

bool same_mask(const Material& a, const Material& b) {
  if (a.mask == nullptr || b.mask == nullptr) return a.mask == b.mask;
  return a.mask == b.mask ||
         (a.mask->cutoff() == b.mask->cutoff() && same(a.mask->image(), b.mask->image()));
}

}  // namespace

bool operator==(const Material& a, const Material& b) {
  return a.name == b.name && a.colour == b.colour && a.reflectance == b.reflectance &&
         same(a.texture, b.texture) && same_mask(a, b);
}

}  // namespace plotscan::mesh
