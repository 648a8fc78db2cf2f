// SPDX-License-Identifier: Apache-2.0
#include "report/page.h"

#include <string>

#include <gmock/gmock.h>

#include "core/error.h"
#include "temporary_folder.h"

namespace plotscan::report {
namespace {

// What stands between the tags of the element with that id.
std::string element(const std::string& page, const std::string& id) {
  const std::size_t tag = page.find("id=\"" + id + "\">");
  if (tag == std::string::npos) return "";
  const std::size_t begin = page.find('>', tag) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

// Pages are too long for messages.
bool has(const std::string& page, const std::string& text) {
  return page.find(text) != std::string::npos;
}

TEST(WritePage, HoldsTheDocumentAndItsBlobsApart) {
  const testing::TemporaryFolder folder;
  const auto html = folder.path() / "page.html";
  write_page(html, {{"title", "T"},
                    {"deep", {{{"data", nlohmann::json::binary({0, 255, 16, 32})}}}},
                    {"one", nlohmann::json::binary({'M'})}});
  const std::string page = read_text(html);
  const nlohmann::json document = nlohmann::json::parse(element(page, "report"));
  EXPECT_EQ(document["title"], "T");
  EXPECT_EQ(document["deep"][0]["data"]["blob"], 0);
  EXPECT_EQ(element(page, "blob-0"), "AP8QIA==");  // RFC 4648, by hand
  EXPECT_EQ(element(page, "blob-1"), "TQ==");
  EXPECT_FALSE(has(page, "<!--plotscan-report-->"));
  EXPECT_TRUE(has(page, "Content-Security-Policy"));
}

TEST(WritePage, HostileTextsEndNoElement) {
  const testing::TemporaryFolder folder;
  const auto html = folder.path() / "page.html";
  const std::vector<std::string> texts = {"</script><script>alert(1)</script>", "\"><img src=x>",
                                          "<!--", "a\xffz", "\u2028&amp;"};
  write_page(html, {{"texts", {texts[0], texts[1], texts[2], texts[3], texts[4]}}, {texts[0], 1}});
  const std::string page = read_text(html);
  EXPECT_FALSE(has(page, "<script>alert"));
  EXPECT_FALSE(has(page, "<img"));
  const nlohmann::json document = nlohmann::json::parse(element(page, "report"));
  for (const std::size_t i : {0, 1, 2, 4}) EXPECT_EQ(document["texts"][i], texts[i]);
  EXPECT_EQ(document["texts"][3], "a\uFFFDz");
  EXPECT_EQ(document[texts[0]], 1);
}

// Nothing that a browser would fetch.
TEST(Template, NeedsNoNetworkAndStaysSmall) {
  const std::string page = read_text(PLOTSCAN_SOURCE_DIR "/report/template.html");
  EXPECT_LT(page.size(), 1'000'000U);
  EXPECT_TRUE(has(page, "default-src 'none'"));
  EXPECT_FALSE(has(page, "src=\""));
  EXPECT_FALSE(has(page, "href=\"http"));
  EXPECT_FALSE(has(page, "@import"));
}

}  // namespace
}  // namespace plotscan::report
