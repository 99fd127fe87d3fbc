#include "daemon/report/sections/why_not_listed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kEnteredUs = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

/// The one entry of the list of findings.
std::string said_of(const storage::HiddenRow& row) {
  const std::string html = why_not_listed({row}, {}).html;
  const std::string start = "<dt>Not on the list</dt><dd>", end = "</dd>";
  EXPECT_TRUE(html.starts_with(start) && html.ends_with(end)) << html;
  return html.substr(start.size(), html.size() - start.size() - end.size());
}

TEST(WhyNotListed, EveryReasonIsASentence) {
  EXPECT_EQ(said_of({"victim", "", "", 0, {}, 3, "FIC1"}),
            "Affected by plant-wide oscillation 3: repair its source <bdi>FIC1</bdi> first, then "
            "check again.");
  EXPECT_EQ(said_of({"victim", "", "", 0, {}, 4, {}}),
            "Affected by plant-wide oscillation 4, whose source is not known.");
  EXPECT_EQ(
      said_of(
          {"probability", "not sure enough for the list (probability 0.40)", "", 0, {}, {}, {}}),
      "Not sure enough for the list (probability 0.40).");
  EXPECT_EQ(
      said_of({"suppressed", "shut down", "eve", kEnteredUs, kEnteredUs + 3'600'000'000, {}, {}}),
      "Suppressed by <bdi>eve</bdi>, 2026-03-01 12:00 UTC, until 2026-03-01 13:00 UTC: "
      "<bdi>shut down</bdi>");
  EXPECT_EQ(said_of({"false_positive", "", "eve", kEnteredUs, {}, {}, {}}),
            "Marked as a false positive by <bdi>eve</bdi>, 2026-03-01 12:00 UTC.");
  EXPECT_EQ(
      said_of({"acknowledged", "order 4711", "ls", kEnteredUs, {}, {}, {}, "<J. Doe>"}),
      "Acknowledged by <bdi>&lt;J. Doe&gt; (login ls)</bdi>, 2026-03-01 12:00 UTC, until work "
      "done since is entered and a window lies wholly after it: <bdi>order 4711</bdi>");
}

TEST(WhyNotListed, OnAPageWhatWasSaidCanBeWithdrawn) {
  const std::string address = "/annotate?name=A%26B";
  EXPECT_THAT(
      why_not_listed({{"false_positive", "", "eve", kEnteredUs, {}, {}, {}}}, {}, address).html,
      testing::HasSubstr("12:00 UTC. <a href=\"/annotate?name=A%26B\">Withdraw…</a></dd>"));
  EXPECT_THAT(why_not_listed({{"victim", "", "", 0, {}, 3, "FIC1"}}, {}, address).html,
              testing::Not(testing::HasSubstr("annotate")));
}

TEST(WhyNotListed, NothingHidesNothingIsSaid) {
  EXPECT_EQ(why_not_listed({}, {}).html, "");
}

}  // namespace
}  // namespace loopscope::daemon
