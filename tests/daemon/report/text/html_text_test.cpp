#include "daemon/report/text/html_text.hpp"

#include <gtest/gtest.h>
#include <string_view>

#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

TEST(HtmlText, WhatHtmlReadsBecomesAReference) {
  EXPECT_EQ(html("a<b>&\"'c"), "a&lt;b&gt;&amp;&quot;&#39;c");
  EXPECT_EQ(html("F\u00fcllstand 20 \u00b0C"), "F\u00fcllstand 20 \u00b0C");
}

TEST(HtmlText, WhatSteersIsShownAsBytes) {
  EXPECT_EQ(html("\u202eX"), "\\xe2\\x80\\xaeX");
  EXPECT_EQ(html("a\nb"), "a\\x0ab");
}

TEST(HtmlText, NoHostileNameLeavesTextOrAttribute) {
  for (const auto& [about, name] : tests::hostile_names()) {
    const std::string shown = html(name);
    EXPECT_EQ(shown.find_first_of("<>\"'"), std::string::npos) << about;
    // An ampersand begins one of our references and nothing else.
    for (std::size_t at = shown.find('&'); at != std::string::npos; at = shown.find('&', at + 1)) {
      const std::string reference = shown.substr(at, shown.find(';', at) - at + 1);
      EXPECT_TRUE(reference == "&amp;" || reference == "&lt;" || reference == "&gt;" ||
                  reference == "&quot;" || reference == "&#39;")
          << about << ": " << reference;
    }
    EXPECT_TRUE(tests::is_harmless_on_a_terminal(shown)) << about;
  }
}

TEST(HtmlText, ValuesOfQueriesAreOneValue) {
  EXPECT_EQ(url_value("FIC-101_a.b~"), "FIC-101_a.b~");
  EXPECT_EQ(url_value("a b&c=d#e%\u00fc"), "a%20b%26c%3Dd%23e%25%C3%BC");
  for (const auto& [about, name] : tests::hostile_names())
    EXPECT_EQ(url_value(name).find_first_of("<>\"' &?#/\\\n"), std::string::npos) << about;
}

}  // namespace
}  // namespace loopscope::daemon
