// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace plotscan::sdfxml {

// XML written element by element.
class XmlWriter {
 public:
  ~XmlWriter();
  XmlWriter(XmlWriter&&) noexcept;

  void open(const char* element);
  void open(const char* element, const std::string& name);  // with the attribute name="..."
  void attribute(const char* name, const std::string& value);
  void content(const std::string& value);
  void close();
  // <element>value</element>
  void text(const char* element, const std::string& value);
  // An element that holds such elements.
  void texts(const char* element,
             std::initializer_list<std::pair<const char*, std::string>> values);

 protected:
  class Printer;
  explicit XmlWriter(std::unique_ptr<Printer> printer);
  Printer& printer() { return *printer_; }

 private:
  std::unique_ptr<Printer> printer_;
};

// An XML file, so that memory does not grow with the farm.
class XmlFile : public XmlWriter {
 public:
  // Throws WriteError when the file cannot be written.
  explicit XmlFile(const std::filesystem::path& path);

  // Appends whole elements that XmlElements printed for the number of elements now open.
  void append(const std::string& elements);

  // Throws WriteError when anything could not be written.
  void finish();

 private:
  XmlFile(const std::filesystem::path& path, std::FILE* file);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

// Elements in memory, for a file in which `depth` elements are open.
class XmlElements : public XmlWriter {
 public:
  explicit XmlElements(int depth);

  std::string printed();
};

}  // namespace plotscan::sdfxml
