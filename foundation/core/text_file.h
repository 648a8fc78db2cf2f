// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/number_text.h"

namespace plotscan {

// Writes a text file. Numbers are written as the shortest text that reads back as the same number.
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
    return *this << std::string_view(NumberText(value));
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

// Writes a file that holds the text. Throws WriteError when it cannot be written.
inline void write_text_file(const std::filesystem::path& path, std::string_view text) {
  TextFile file(path);
  file << text;
  file.close();
}

}  // namespace plotscan
