// SPDX-License-Identifier: Apache-2.0
#include "plotscan/data.h"

#include "boundary/guarded.h"
#include "core/data_folder.h"
#include "core/manifest.h"

namespace plotscan {

std::string library_version() { return version(); }

std::filesystem::path shipped_data() {
  return boundary::guarded([] { return data_folder(); });
}

}  // namespace plotscan
