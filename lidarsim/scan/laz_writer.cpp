// SPDX-License-Identifier: Apache-2.0
#include "scan/laz_writer.h"

#include <utility>

#include "core/error.h"
#include "scan/internal/laszip_file.h"

namespace plotscan::scan {
namespace {

// Packs a LAS file into a LAZ file.
void pack(const std::filesystem::path& las, const std::filesystem::path& laz) {
  const LaszipFile reader(las);
  laszip_BOOL compressed = 0;
  reader.require(laszip_open_reader(reader.get(), las.c_str(), &compressed));
  const LaszipFile writer(laz);
  writer.require(laszip_preserve_generating_software(writer.get(), 1));
  writer.require(laszip_set_header(writer.get(), &reader.header()));
  writer.require(laszip_request_native_extension(writer.get(), 1));
  writer.require(laszip_open_writer(writer.get(), laz.c_str(), 1));
  const laszip_point_struct& point = reader.point();
  for (std::uint64_t i = 0; i < reader.header().extended_number_of_point_records; ++i) {
    reader.require(laszip_read_point(reader.get()));
    writer.require(laszip_set_point(writer.get(), &point));
    writer.require(laszip_write_point(writer.get()));
  }
  writer.require(laszip_close_writer(writer.get()));
  reader.require(laszip_close_reader(reader.get()));
}

}  // namespace

LazWriter::LazWriter(const std::filesystem::path& path, LasOptions options)
    : path_(path),
      unpacked_(std::filesystem::path(path).replace_extension(".unpacked.las")),
      las_(unpacked_.path(), std::move(options)) {}

void LazWriter::close() {
  las_.close();
  try {
    pack(unpacked_.path(), path_);
  } catch (const InputError&) {
    // LASzip gives no reason; as the LAS file was just written, only writing can have failed.
    throw WriteError(path_);
  }
}

}  // namespace plotscan::scan
