// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"

namespace plotscan {

// The shortest text that reads back as the same number.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
void append_number(std::string& text, Number value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), end);
}

// A text file being written, its numbers as the shortest text that reads back as the same number.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& path)
      : path_(path), out_(path, std::ios::binary) {}

  TextFile& operator<<(std::string_view text) {
    out_.write(text.data(), static_cast<std::streamsize>(text.size()));
    return *this;
  }
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number> TextFile& operator<<(Number value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return *this << std::string_view(buffer.data(), end);
  }

  // Throws WriteError when anything could not be written.
  void close() {
    out_.close();
    if (!out_) throw WriteError(path_);
  }

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace plotscan
