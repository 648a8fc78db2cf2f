// SPDX-License-Identifier: Apache-2.0
#include "record/ros/internal/unpack.h"

#include <memory>

#include <lz4frame.h>
#include <zstd.h>

#include "core/error.h"

namespace plotscan::record {
namespace {

// The largest chunk that is unpacked; those of recordings take megabytes.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

[[noreturn]] void fail() { throw InputError("is broken: a chunk does not unpack to its size"); }

void unpack_lz4(std::span<const char> packed, std::vector<char>& bytes) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) fail();
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, LZ4F_freeDecompressionContext);
  std::size_t done = 0;
  std::size_t more = 1;  // 0: the frame is whole
  while (more != 0) {
    std::size_t written = bytes.size() - done;
    std::size_t read = packed.size();
    more = LZ4F_decompress(context, bytes.data() + done, &written, packed.data(), &read, nullptr);
    if (LZ4F_isError(more) != 0 || (written == 0 && read == 0)) fail();
    done += written;
    packed = packed.subspan(read);
  }
  if (done != bytes.size()) fail();
}

void unpack_zstd(std::span<const char> packed, std::vector<char>& bytes) {
  const std::size_t size =
      ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
  if (ZSTD_isError(size) != 0 || size != bytes.size()) fail();
}

}  // namespace

std::vector<char> unpacked(const std::string& method, std::span<const char> packed,
                           std::uint64_t size) {
  const bool plain = method.empty() || method == "none";
  if (!plain && method != "lz4" && method != "zstd") {
    throw InputError("holds chunks compressed by " + method +
                     "; lz4, zstd and uncompressed chunks are read");
  }
  if (plain ? size != packed.size() : size > kMostBytes) fail();
  if (plain) return {packed.begin(), packed.end()};
  std::vector<char> bytes(size);
  if (method == "lz4")
    unpack_lz4(packed, bytes);
  else
    unpack_zstd(packed, bytes);
  return bytes;
}

}  // namespace plotscan::record
