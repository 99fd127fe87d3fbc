#include "daemon/report/live/live_trend.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "daemon/report/page/page_assets.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/sections/loop_section.hpp"
#include "daemon/report/text/base64.hpp"
#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/daemon/report/sample_rows.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::kMissing;
using core::signal::Samples;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kSamples = 4096;

Samples noise(unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> value(50.0, 1.0);
  Samples values(kSamples);
  for (double& one : values) one = value(random);
  return values;
}

/// An output of 4 to 20 mA in a window whose clock goes from CET to CEST.
LoopEvidence evidence(const Samples& sp) {
  LoopEvidence seen;
  core::signal::LoopWindow& window = seen.at_slot.window;
  window.start_us = 1'774'742'400'000'000;  // 2026-03-29 00:00 UTC
  window.sample_interval_s = 2.5;
  window.sp = sp;
  window.pv = noise(1);
  window.op = noise(2);
  seen.prepared.pv = window.pv;
  seen.prepared.op_range.range = core::signal::OpRange{4.0, 20.0};
  return seen;
}

std::string trend(const LoopEvidence& seen, const std::string& unit = "bar") {
  return live_trend(seen, unit, TimeZone("Europe/Berlin")).html;
}

nlohmann::json window_of(const std::string& html) {
  const std::string opening = "data-window=\"", quote = "&quot;";
  const std::size_t begin = html.find(opening) + opening.size();
  std::string text = html.substr(begin, html.find('"', begin) - begin);
  for (std::size_t at = text.find(quote); at != std::string::npos; at = text.find(quote))
    text.replace(at, quote.size(), "\"");
  return nlohmann::json::parse(text);
}

TEST(LiveTrend, HoldsTheWindowWithTimesUnitsAndClocks) {
  Samples sp(kSamples, 40.0);
  sp[0] = kMissing;
  const std::string html = trend(evidence(sp));
  const nlohmann::json window = window_of(html);
  EXPECT_EQ(window.at("start_us"), 1'774'742'400'000'000);
  EXPECT_EQ(window.at("interval_s"), 2.5);
  EXPECT_EQ(window.at("samples"), kSamples);
  EXPECT_EQ(window.at("op_range"), nlohmann::json({4.0, 20.0}));
  EXPECT_EQ(window.at("sp"), nlohmann::json({1, nullptr, kSamples - 1, 40.0}));
  EXPECT_TRUE(window.at("pv").is_string());
  EXPECT_FALSE(window.contains("mv")) << "not recorded";
  EXPECT_FALSE(window.contains("pv_rows")) << "every sample is a row";
  EXPECT_THAT(html, HasSubstr("data-pv-unit=\"bar\" data-op-unit=\"%\""));
  EXPECT_THAT(html, HasSubstr(" 3600000000\">CET</data><data hidden value=\"1774746000000000 "
                              "7200000000\">CEST</data>"));
}

TEST(LiveTrend, TellsWhichSamplesAreRows) {
  LoopEvidence seen = evidence(Samples(kSamples, 40.0));
  seen.at_slot.window.pv_rows.assign(kSamples, kMissing);
  seen.prepared.op_range.range.reset();
  const std::string html = trend(seen);
  EXPECT_EQ(window_of(html).at("pv_rows").get<std::string>().size(), kSamples / 8 / 3 * 4 + 4);
  EXPECT_FALSE(window_of(html).contains("op_range"));
  EXPECT_THAT(html, HasSubstr("data-op-unit=\"op units\""));
}

TEST(LiveTrend, TakesLittleRoom) {
  constexpr std::size_t kSeries = 22'000, kRest = 1'000;
  LoopEvidence seen = evidence(Samples(kSamples, 40.0));
  EXPECT_LT(trend(seen).size(), 2 * kSeries + kRest);
  seen.at_slot.window.sp = noise(3);
  seen.at_slot.window.mv = noise(4);
  EXPECT_LT(trend(seen).size(), 4 * kSeries + kRest);
}

TEST(LiveTrend, AUnitIsText) {
  const LoopEvidence seen = evidence({});
  const auto plain = tags_of(trend(seen));
  for (const auto& [about, name] : tests::hostile_names()) {
    const std::string html = trend(seen, name);
    EXPECT_EQ(tags_of(html), plain) << about;
    EXPECT_EQ(window_of(html).at("samples"), kSamples) << about;
    EXPECT_THAT(html, HasSubstr("data-pv-unit=\"" + loopscope::daemon::html(name) + "\"")) << about;
  }
}

TEST(LiveTrend, IsNotThereWithoutAWindow) {
  EXPECT_EQ(live_trend({}, "bar", {}).html, "");
}

TEST(LiveTrend, OnlyALivePageHasItAndItsScript) {
  LoopReport told;
  told.row = flagged_row(7, "FIC101");
  told.pictures = {{"t", "a", "<svg/>", 5, 5, true}, {"t", "a", "<svg/>", 5, 5}};
  const Markup shown = live_trend(evidence({}), "bar", {});
  const std::string live =
      page({.title = "t", .subtitle = {}, .trend = true}, {loop_section(told, shown)});
  EXPECT_THAT(live, HasSubstr(shown.html));
  EXPECT_THAT(live, HasSubstr(trend_script().text));
  EXPECT_EQ(unbalanced(loop_section(told, shown).html), "");
  const std::string report = page({.title = "t", .subtitle = {}}, {loop_section(told)});
  EXPECT_THAT(report, Not(HasSubstr("data-window")));
  EXPECT_THAT(report, Not(HasSubstr(trend_script().text)));
  EXPECT_THAT(report, HasSubstr("<figure class=\"whole-window\">"));
  EXPECT_THAT(content_security_policy(), HasSubstr(csp_hash(trend_script().sha256)));
}

}  // namespace
}  // namespace loopscope::daemon
