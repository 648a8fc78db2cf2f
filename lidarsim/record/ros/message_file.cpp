// SPDX-License-Identifier: Apache-2.0
#include "record/ros/message_file.h"

#include "record/ros/internal/bag_format.h"
#include "record/ros/internal/binary_file.h"
#include "record/ros/internal/mcap_format.h"

namespace plotscan::record::ros {

void read_messages(const std::filesystem::path& file, const MessageSink& sink) {
  try {
    const bool is_bag = BinaryInput(file).number<char>() == '#';
    (is_bag ? read_bag : read_mcap)(file, sink);
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.starts_with(file.string())) throw;
    throw InputError(file, what);
  }
}

}  // namespace plotscan::record::ros
