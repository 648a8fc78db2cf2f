// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace tinyxml2 {
class XMLPrinter;
}

namespace plotscan::sdfxml {

// An XML file written element by element, so that memory does not grow with the farm.
class XmlFile {
 public:
  // Throws WriteError when the file cannot be written.
  explicit XmlFile(const std::filesystem::path& path);
  ~XmlFile();
  XmlFile(XmlFile&&) noexcept;

  void open(const char* element);
  void open(const char* element, const std::string& name);  // with the attribute name="..."
  void attribute(const char* name, const std::string& value);
  void content(const std::string& value);
  void close();
  // <element>value</element>
  void text(const char* element, const std::string& value);

  // Throws WriteError when anything could not be written.
  void finish();

 private:
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::unique_ptr<tinyxml2::XMLPrinter> printer_;
};

}  // namespace plotscan::sdfxml
