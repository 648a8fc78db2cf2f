// SPDX-License-Identifier: Apache-2.0
#include "sdfxml/xml_file.h"

#include <tinyxml2.h>

#include "core/error.h"

namespace plotscan::sdfxml {

class XmlWriter::Printer : public tinyxml2::XMLPrinter {
 public:
  using XMLPrinter::XMLPrinter;

  void append(const std::string& elements) {
    SealElementIfJustOpened();
    Write(elements.data(), elements.size());
  }
};

XmlWriter::XmlWriter(std::unique_ptr<Printer> printer) : printer_(std::move(printer)) {}

XmlWriter::~XmlWriter() = default;

XmlWriter::XmlWriter(XmlWriter&&) noexcept = default;

void XmlWriter::open(const char* element) { printer_->OpenElement(element); }

void XmlWriter::open(const char* element, const std::string& name) {
  open(element);
  attribute("name", name);
}

void XmlWriter::attribute(const char* name, const std::string& value) {
  printer_->PushAttribute(name, value.c_str());
}

void XmlWriter::content(const std::string& value) { printer_->PushText(value.c_str()); }

void XmlWriter::close() { printer_->CloseElement(); }

void XmlWriter::text(const char* element, const std::string& value) {
  open(element);
  content(value);
  close();
}

void XmlWriter::texts(const char* element,
                      std::initializer_list<std::pair<const char*, std::string>> values) {
  open(element);
  for (const auto& [name, value] : values) text(name, value);
  close();
}

XmlFile::XmlFile(const std::filesystem::path& path)
    : XmlFile(path, std::fopen(path.c_str(), "wb")) {}

XmlFile::XmlFile(const std::filesystem::path& path, std::FILE* file)
    : XmlWriter(std::make_unique<Printer>(file)), path_(path), file_(file, &std::fclose) {
  if (!file_) throw WriteError(path_);
  printer().PushHeader(false, true);
}

void XmlFile::append(const std::string& elements) { printer().append(elements); }

void XmlFile::finish() {
  if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0) throw WriteError(path_);
}

XmlElements::XmlElements(int depth) : XmlWriter(std::make_unique<Printer>(nullptr, false, depth)) {}

// A first element begins on the line at hand, in a file each on a line of its own.
std::string XmlElements::printed() { return std::string("\n") + printer().CStr(); }

}  // namespace plotscan::sdfxml
