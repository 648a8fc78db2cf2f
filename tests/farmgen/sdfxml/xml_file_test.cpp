// SPDX-License-Identifier: Apache-2.0
#include "sdfxml/xml_file.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "temporary_folder.h"

namespace plotscan::sdfxml {
namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void write_visual(XmlWriter& xml, int number) {
  xml.open("visual", "plant & " + std::to_string(number));
  xml.text("pose", "0 0 " + std::to_string(number));
  xml.open("geometry");
  xml.close();
  xml.close();
}

// A model of four visuals, by whatever writes them.
template <class Visuals>
std::string document(const std::filesystem::path& file, const Visuals& write_visuals) {
  XmlFile xml(file);
  xml.open("model", "plot_1");
  xml.open("link");
  write_visuals(xml);
  xml.text("static", "true");
  xml.close();
  xml.close();
  xml.finish();
  return text_of(file);
}

TEST(XmlFile, HasTheSameBytesWherePartsArePrintedApart) {
  const testing::TemporaryFolder folder;
  const std::string whole = document(folder.path() / "whole.sdf", [](XmlFile& xml) {
    for (int i = 0; i < 4; ++i) write_visual(xml, i);
  });
  const std::string parts = document(folder.path() / "parts.sdf", [](XmlFile& xml) {
    for (int begin = 0; begin < 4; begin += 2) {
      XmlElements elements(2);
      write_visual(elements, begin);
      write_visual(elements, begin + 1);
      xml.append(elements.printed());
    }
  });
  EXPECT_NE(whole.find("<visual name=\"plant &amp; 3\">"), std::string::npos) << whole;
  EXPECT_EQ(parts, whole);
}

}  // namespace
}  // namespace plotscan::sdfxml
