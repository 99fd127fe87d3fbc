#include "daemon/report/page/template.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

#include "daemon/report/page/page_assets.hpp"
#include "daemon/report/text/html_text.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;

std::string filled(std::string_view text, Fields fields) {
  return Template("t", text).render(std::move(fields)).html;
}

/// What the error says; empty = none.
std::string error_of(std::string_view text, Fields fields) {
  try {
    static_cast<void>(filled(text, std::move(fields)));
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}

TEST(Template, ATextIsEscapedBetweenTagsAndInAttributes) {
  EXPECT_EQ(filled("<b title=\"{{a}}\">{{a}}</b>", {{"a", "<i> & \"'\u202e"}}),
            "<b title=\"&lt;i&gt; &amp; &quot;&#39;\\xe2\\x80\\xae\">"
            "&lt;i&gt; &amp; &quot;&#39;\\xe2\\x80\\xae</b>");
  EXPECT_EQ(filled("{{a}}", {{"a", "\xff\n{{a}}"}}), "\\xff\\x0a{{a}}");
  EXPECT_EQ(filled("{{a}}", {{"a", std::int64_t{-7}}}), "-7");
}

TEST(Template, EveryHostileNameIsWhatHtmlMakesOfIt) {
  for (const auto* names : {&tests::hostile_names(), &tests::impossible_names()})
    for (const auto& [about, name] : *names)
      EXPECT_EQ(
          filled("[{{a}}{{#l}}{{.}}{{/l}}]", {{"a", name}, {"l", std::vector<std::string>{name}}}),
          "[" + html(name) + html(name) + "]")
          << about;
}

TEST(Template, TextAndMarkupAreNotTakenForEachOther) {
  EXPECT_EQ(filled("{{{a}}}", {{"a", Markup("<b>")}}), "<b>");
  EXPECT_EQ(error_of("{{{a}}}", {{"a", "<b>"}}), "template t: a is no Markup");
  EXPECT_EQ(error_of("{{a}}", {{"a", Markup("<b>")}}), "template t: a is no text");
  EXPECT_EQ(error_of("{{#l}}{{{.}}}{{/l}}", {{"l", std::vector<std::string>{"<b>"}}}),
            "template t: . is no Markup");
  EXPECT_EQ(error_of("{{a}}", {{"a", true}}), "template t: a is no text");
}

TEST(Template, ANameThatIsMissingIsAnError) {
  EXPECT_EQ(error_of("{{b}}", {{"a", "x"}}), "template t: b is missing");
  EXPECT_EQ(error_of("{{{b}}}", {{"a", "x"}}), "template t: b is missing");
  EXPECT_EQ(error_of("{{#b}}x{{/b}}", {{"a", "x"}}), "template t: b is missing");
  EXPECT_EQ(error_of("{{^b}}x{{/b}}", {{"a", "x"}}), "template t: b is missing");
  EXPECT_THROW(static_cast<void>(render("no_such_template", {})), std::logic_error);
}

TEST(Template, WhatDoesNotParseIsAnError) {
  EXPECT_THAT(error_of("{{#a}}x", {{"a", true}}), HasSubstr("template t: Unclosed section"));
  EXPECT_THAT(error_of("x{{/a}}", {{"a", true}}), HasSubstr("template t: Unopened section"));
  EXPECT_THAT(error_of("{{a", {{"a", "x"}}), HasSubstr("template t: Unclosed tag"));
  for (const char* foreign : {"{{>a}}", "{{&a}}", "{{=<% %>=}}"})
    EXPECT_THAT(error_of(foreign, {{"a", "x"}}), HasSubstr("is not for templates")) << foreign;
}

TEST(Template, SectionsAreShownForWhatIsThere) {
  const std::string_view text = "{{#a}}yes{{/a}}{{^a}}no{{/a}}";
  for (const Value& there :
       {Value(true), Value("x"), Value(std::int64_t{0}), Value(Markup("x")), Value(Fields())})
    EXPECT_EQ(filled(text, {{"a", there}}), "yes") << there.index();
  for (const Value& nothing : {Value(false), Value(""), Value(Markup()), Value(List())})
    EXPECT_EQ(filled(text, {{"a", nothing}}), "no") << nothing.index();
}

TEST(Template, ListsInListsSeeWhatStandsAroundThem) {
  const List inner = {Fields{{"b", "1"}}, Fields{{"b", "2"}}};
  const List outer = {Fields{{"a", "x"}, {"inner", inner}}, Fields{{"a", "y"}, {"inner", List()}}};
  EXPECT_EQ(filled("{{#outer}}{{a}}{{#inner}}{{#c}}{{a}}{{b}}{{c}}{{/c}}{{/inner}};{{/outer}}",
                   {{"outer", outer}, {"c", "!"}}),
            "xx1!x2!;y;");
  EXPECT_EQ(filled("{{#l}}{{.}},{{/l}}", {{"l", std::vector<std::string>{"a", "", "<"}}}),
            "a,,&lt;,");
}

TEST(Template, LinesGoOnAfterABackslashAndTagsOfSectionsTakeNone) {
  EXPECT_EQ(filled("<tr>\\\n<td>\n{{#a}}\nx\n{{/a}}\n{{^a}}\ny\n{{/a}}\nz\n", {{"a", false}}),
            "<tr><td>\ny\nz");
  EXPECT_EQ(filled("{{#a}}\nx\n{{/a}}\n", {{"a", true}}), "x");
}

TEST(Template, ManyThreadsRenderTheSameOne) {
  const Template shared("t", "{{#l}}{{.}}{{/l}}{{a}}");
  const Fields fields = {{"l", std::vector<std::string>(50, "<")}, {"a", "&"}};
  const std::string expected = shared.render(fields).html;
  std::vector<std::jthread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int times = 0; times < 50; ++times) EXPECT_EQ(shared.render(fields).html, expected);
    });
}

TEST(Template, EveryOneOfThePagesParsesAndPutsNamesIntoQuotesOnly) {
  EXPECT_FALSE(page_templates().empty());
  for (const PageTemplate& asset : page_templates()) {
    EXPECT_NO_THROW(Template(asset.name, asset.text)) << asset.name;
    // What html() makes of a text is safe between tags and in double quotes, and nowhere else.
    for (const char* outside : {"={{", "='{{", "<{{", "</{{"})
      EXPECT_EQ(std::string_view(asset.text).find(outside), std::string_view::npos)
          << asset.name << ": " << outside;
  }
}

TEST(Template, PagesThatSayWhatIsNotThereEscapeToo) {
  EXPECT_THAT(render("no_such_loop", {{"name", "<b>'"}}).html,
              HasSubstr("<bdi>&lt;b&gt;&#39;</bdi>"));
  EXPECT_THAT(render("results_away", {}).html, HasSubstr("<a href=\"/readyz\">"));
}

}  // namespace
}  // namespace loopscope::daemon
