// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace plotscan {

// Packs values one after the other in this machine's own memory layout, to pass them from one
// process of a program to another. A list or text is preceded by its number of entries.
class ByteWriter {
 public:
  template <class Value>
  ByteWriter& put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  // The text in a field of `size` bytes: cut off, or filled up with zeros.
  ByteWriter& put_field(std::string_view text, std::size_t size) {
    bytes_.append(text.substr(0, size)).append(size - std::min(size, text.size()), '\0');
    return *this;
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  // Entries are numbers, or hold a fixed number of them (std::array, Eigen's vectors).
  template <class Entry>
  void put_list(const std::vector<Entry>& list) {
    static_assert(std::is_standard_layout_v<Entry>);
    put(static_cast<std::uint64_t>(list.size()));
    if (list.empty()) return;
    bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Entry));
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads the values of a ByteWriter back, in the same order. Throws std::runtime_error when the
// bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class Value>
  Value get() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value{};
    std::memcpy(&value, next(1, sizeof value).data(), sizeof value);
    return value;
  }
  std::string get_text() { return std::string(next(get<std::uint64_t>(), 1)); }
  template <class Entry>
  std::vector<Entry> get_list() {
    static_assert(std::is_standard_layout_v<Entry>);
    const auto count = get<std::uint64_t>();
    const std::string_view bytes = next(count, sizeof(Entry));
    std::vector<Entry> list(count);
    if (count > 0) std::memcpy(static_cast<void*>(list.data()), bytes.data(), bytes.size());
    return list;
  }

 private:
  std::string_view next(std::uint64_t count, std::size_t size) {
    if (count > rest_.size() / size) throw std::runtime_error("bytes end too early");
    const std::string_view taken = rest_.substr(0, count * size);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string_view rest_;
};

}  // namespace plotscan
