#include "daemon/report/report_page.hpp"

#include <gtest/gtest.h>

#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

constexpr int kLoops = 40;

/// Forty flagged loops in two areas by turns, and one in none.
PlantFacts plant(const std::string& area = "north") {
  PlantFacts facts;
  for (int k = 1; k <= kLoops; ++k) {
    storage::FlaggedRow row = flagged_row(k, "FIC" + std::to_string(k));
    if (k > 1) row.area = k % 2 == 0 ? area : "south";
    storage::LoopRow loop;
    loop.enabled = true;
    loop.rank = k;
    loop.area = row.area;
    if (loop.area) loop.area_place = k % 2 + 1;
    facts.flagged.push_back(row);
    facts.loops.push_back(loop);
  }
  return facts;
}

std::vector<LoopReport> reports(const PlantFacts& facts, std::size_t pictured = 0) {
  std::vector<LoopReport> loops;
  for (const storage::FlaggedRow& row : facts.flagged) {
    LoopReport& loop = loops.emplace_back();
    loop.row = row;
    if (loops.size() <= pictured)
      loop.pictures = {{"Trend", "Trend", "<svg>" + std::string(6'000, ' ') + "</svg>", 560, 400}};
  }
  return loops;
}

/// How often; a page is too long to be shown by a test that fails.
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(ReportPage, HasASectionForEachLoopByArea) {
  const PlantFacts facts = plant();
  const ReportPage page = report_page(facts, reports(facts));
  EXPECT_EQ(page.sections, std::size_t{kLoops});
  EXPECT_EQ(count(page.html, "<section class=\"loop\""), std::size_t{kLoops});
  EXPECT_EQ(count(page.html, "<section class=\"area\""), 3U);
  EXPECT_GT(count(page.html, "<a href=\"#area-2\"><bdi>north</bdi></a>"), 0U);
  EXPECT_GT(count(page.html, "id=\"area-2\""), 0U);
  EXPECT_LT(page.html.find("id=\"loop-2\""), page.html.find("id=\"loop-4\""));
  EXPECT_LT(page.html.find("id=\"loop-40\""), page.html.find("id=\"loop-3\"")) << "another area";
  EXPECT_EQ(unbalanced(page.html), "");
}

TEST(ReportPage, WithoutAreasIsInTheOrderOfTheList) {
  PlantFacts facts = plant();
  facts.loops = without_areas(facts.loops);
  const std::string text = report_page(facts, reports(facts)).html;
  EXPECT_EQ(count(text, "class=\"area\""), 0U);
  EXPECT_LT(text.find("id=\"loop-2\""), text.find("id=\"loop-3\""));
}

TEST(ReportPage, StaysWithinItsSizeAndSaysWhatItLeftOut) {
  const PlantFacts facts = plant();
  constexpr std::size_t kMost = 140'000;
  const ReportPage page = report_page(facts, reports(facts, 10), "", kMost);
  EXPECT_LT(page.html.size(), kMost + 30'000) << "the frame with its style and script";
  EXPECT_GT(page.pictured, 0U);
  EXPECT_LT(page.pictured, 10U);
  EXPECT_LT(page.sections, std::size_t{kLoops});
  EXPECT_GT(count(page.html, "stand in the list alone"), 0U);
  EXPECT_GT(count(page.html, html(kNoRoomForPictures)), 0U);
  EXPECT_EQ(count(page.html, "href=\"#loop-40\""), 0U) << "leads nowhere";
  EXPECT_GT(count(page.html, "<bdi>FIC40</bdi>"), 0U) << "the list is whole";
}

TEST(ReportPage, ALoopWithoutPicturesTakesNothingFromThoseBehindIt) {
  const PlantFacts facts = plant();
  std::vector<LoopReport> loops = reports(facts, 10);
  loops[0].pictures.clear();
  loops[0].trouble = "the historian is away";
  const ReportPage page = report_page(facts, loops);
  EXPECT_EQ(page.pictured, 9U);
  EXPECT_EQ(count(page.html, "the historian is away"), 1U);
  EXPECT_EQ(count(page.html, html(kNoRoomForPictures)), 0U);
}

TEST(ReportPage, LeadsToTheDaemonsPagesOfTheOthers) {
  const PlantFacts facts = plant();
  const std::string text = report_page(facts, reports(facts), "https://pages", 100'000).html;
  EXPECT_GT(count(text, "href=\"#loop-1\""), 0U);
  EXPECT_GT(count(text, "href=\"https://pages/loop?name=FIC40\""), 0U);
}

TEST(ReportPage, NoHostileAreaChangesTheMarkup) {
  const PlantFacts facts = plant();
  const std::vector<std::string> tags = tags_of(report_page(facts, reports(facts)).html);
  for (const auto& [about, name] : tests::hostile_names()) {
    const PlantFacts hostile = plant(name);
    EXPECT_EQ(tags_of(report_page(hostile, reports(hostile)).html), tags) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
