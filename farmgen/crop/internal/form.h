// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plotscan::crop {

// How a crop is drawn: how its organs grow, and how their surfaces look (crop/internal/textures.h).
// Named after the crop that each was made for; others may have the same.
enum class Form { soybean, wheat, maize };

}  // namespace plotscan::crop
