// SPDX-License-Identifier: Apache-2.0
#include "sdfxml/xml_file.h"

#include <tinyxml2.h>

#include "core/error.h"

namespace plotscan::sdfxml {

XmlFile::XmlFile(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "wb"), &std::fclose) {
  if (!file_) throw WriteError(path_);
  printer_ = std::make_unique<tinyxml2::XMLPrinter>(file_.get());
  printer_->PushHeader(false, true);
}

XmlFile::~XmlFile() = default;

XmlFile::XmlFile(XmlFile&&) noexcept = default;

void XmlFile::open(const char* element) { printer_->OpenElement(element); }

void XmlFile::open(const char* element, const std::string& name) {
  open(element);
  attribute("name", name);
}

void XmlFile::attribute(const char* name, const std::string& value) {
  printer_->PushAttribute(name, value.c_str());
}

void XmlFile::content(const std::string& value) { printer_->PushText(value.c_str()); }

void XmlFile::close() { printer_->CloseElement(); }

void XmlFile::text(const char* element, const std::string& value) {
  open(element);
  content(value);
  close();
}

void XmlFile::finish() {
  if (std::fflush(file_.get()) != 0 || std::ferror(file_.get()) != 0) throw WriteError(path_);
}

}  // namespace plotscan::sdfxml
