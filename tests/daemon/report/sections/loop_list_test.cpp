#include "daemon/report/sections/loop_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/sections/loop_request.hpp"
#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LoopList, LinksToLoopsThatHaveAPage) {
  storage::LoopRow seen, never;
  seen.name = "a&b";
  seen.code = "healthy";
  never.name = "never";
  seen.state = "disabled";
  seen.hidden_by = "disabled";
  never.state = "never analysed";
  const std::string text = loop_list({.loops = {seen, never}, .fitting = 2, .all = 2}, {}, {}).html;
  EXPECT_THAT(text, HasSubstr("href=\"/loop?name=a%26b\""));
  EXPECT_THAT(text, HasSubstr("<bdi>never</bdi>"));
  EXPECT_THAT(text, Not(HasSubstr("name=never")));
  EXPECT_THAT(text, HasSubstr("<td data-label=\"State\">never analysed</td>"));
  EXPECT_THAT(text, HasSubstr("<td data-label=\"State\">disabled</td>"));
  EXPECT_EQ(unbalanced(text), "");
}

LoopListing many() {
  LoopListing listing{std::vector<storage::LoopRow>(kLoopsOnPage), 300, 1001, 5000};
  listing.areas = {"north", "south"};
  listing.verdicts = {"healthy", "none"};
  return listing;
}

TEST(LoopList, LeadsToOtherPagesAndOrdersOfTheSameQuestion) {
  const LoopQuery query =
      loop_query({{"area", "north"}, {"page", "3"}, {"order", "name"}, {"q", "FIC"}});
  const std::string text = loop_list(many(), query, {}).html;
  EXPECT_THAT(text, HasSubstr("<output>301 to 450 of 1001 (5000 in all)</output>"));
  EXPECT_THAT(text, HasSubstr("<b aria-current=\"page\">3</b>"));
  EXPECT_THAT(text,
              HasSubstr("href=\"/loops?q=FIC&amp;area=north&amp;order=name&amp;page=7\">7</a>"));
  EXPECT_THAT(text,
              HasSubstr("<th aria-sort=\"ascending\"><a "
                        "href=\"/loops?q=FIC&amp;area=north&amp;order=name&amp;dir=desc\">Loop"));
  EXPECT_THAT(text, HasSubstr("<a href=\"/loops?q=FIC&amp;area=north&amp;order=verdict\">Verdict"));
  EXPECT_THAT(text, HasSubstr("<option value=\"north\" selected>north</option>"));
  EXPECT_THAT(text, HasSubstr("<option value=\"none\">never analysed</option>"));
  EXPECT_THAT(text, HasSubstr("value=\"FIC\""));
  EXPECT_THAT(text, Not(HasSubstr("All units"))) << "no loop has one";
  EXPECT_EQ(unbalanced(text), "");
}

TEST(LoopList, WhereNoLoopFitsItSaysSo) {
  const std::string text = loop_list({.all = 24}, loop_query({{"q", "x"}}), {}).html;
  EXPECT_THAT(text, HasSubstr("none of 24 fits"));
  EXPECT_THAT(text, HasSubstr("No loop fits. <a href=\"/loops\">All loops</a>"));
}

/// The largest come first, and the arrow says so.
TEST(LoopList, ArrowsSayWhichWayTheRowsGo) {
  const auto header_of = [](const char* order, const char* direction) {
    const std::string text =
        loop_list(many(), loop_query({{"order", order}, {"dir", direction}}), {}).html;
    const std::size_t at = text.find("aria-sort=\"") + 11;
    return text.substr(at, text.find('"', at) - at);
  };
  EXPECT_EQ(header_of("confidence", ""), "descending");
  EXPECT_EQ(header_of("confidence", "desc"), "ascending");
  EXPECT_EQ(header_of("window", ""), "descending");
  EXPECT_EQ(header_of("rank", ""), "ascending");
  EXPECT_EQ(header_of("area", "desc"), "descending");
}

/// As in a bookmark.
TEST(LoopList, SaysWhatWasAskedForAlsoWhereNoLoopHasIt) {
  const std::string text =
      loop_list({.all = 24}, loop_query({{"area", "gone"}, {"verdict", "tight_tuning"}}), {}).html;
  EXPECT_THAT(text, HasSubstr("<option value=\"gone\" selected>gone</option>"));
  EXPECT_THAT(text, HasSubstr("<option value=\"tight_tuning\" selected>Tight tuning</option>"));
}

/// Long names, every field filled.
TEST(LoopList, APageIsBelow200KB) {
  LoopListing listing = many();
  for (storage::LoopRow& row : listing.loops) {
    row.name = "NORTH/CRUDE/FIC-10234A/PID1";
    row.area = row.unit = "North, crude distillation";
    row.description = "Reflux of the crude column, second line of the pump";
    row.code = row.shown_code = "external_disturbance";
    row.confidence = 0.75;
    row.slot_end_us = 1;
    row.hidden_by =
        "a fault is probable (0.75), but the surer ones fill the list: with this loop more than "
        "3 % of the loops on it would be expected to have no fault";
    row.follows = "follows LIC-201's oscillation of 19.6 min (23 % of its error)";
    row.health = "never_analysed";
  }
  EXPECT_LT(page({"All loops", {"5000 loops"}, true, "UTC"}, {loop_list(listing, {}, {})}).size(),
            200'000U);
}

TEST(LoopList, NoHostileNameChangesTheMarkup) {
  const auto list_with = [](const std::string& text) {
    storage::LoopRow row;
    row.name = row.health = text;
    row.code = row.status = row.follows = row.shown_code = text;
    storage::LoopRow hidden = row;
    hidden.status.reset();
    hidden.hidden_by = text;
    hidden.shown_code = "external_disturbance";
    row.area = row.unit = row.description = text;
    LoopListing listing{.loops = {row, hidden}, .fitting = 500, .all = 500};
    listing.areas = listing.units = listing.verdicts = {text};
    LoopQuery query;
    query.part = query.area = text;
    return loop_list(listing, query, {}).html;
  };
  for (const auto& [about, name] : tests::hostile_names()) {
    EXPECT_EQ(tags_of(list_with(name)), tags_of(list_with("words"))) << about << ": " << name;
    EXPECT_THAT(list_with(name), HasSubstr("<bdi>" + html(name) + "</bdi></a>")) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
