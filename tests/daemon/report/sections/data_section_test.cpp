#include "daemon/report/sections/data_section.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

constexpr std::int64_t kSinceUs = 1'772'366'400'000'000;  // 2026-03-01T12:00:00Z

TEST(DataSection, WithoutAProblemAndWithoutAWindowItIsOneSentence) {
  EXPECT_EQ(data_section({}).html, "<h3>Data</h3>\n<p>There is no problem with the data.</p>");
}

TEST(DataSection, AProblemHasItsTagAndWhatToDo) {
  LoopReport told;
  told.problems = {
      {"no_rows", "op", "FIC1.OP", "no row in the window", "check the tag", kSinceUs, true}};
  EXPECT_EQ(
      data_section(told).html,
      "<h3>Data</h3>\n<table class=\"problems\"><thead><tr><th>Problem</th><th>Tag</th><th>Since"
      "</th><th>What to do</th></tr></thead><tbody>\n<tr><td data-label=\"Problem\">no row in the "
      "window</td><td data-label=\"Tag\">op <bdi>FIC1.OP</bdi></td><td class=\"when\" "
      "data-label=\"Since\">2026-03-01 12:00 UTC</td><td data-label=\"What to do\">check the tag"
      "</td></tr>\n</tbody></table>");
}

TEST(DataSection, FiguresOfTheWindowHaveTheirUnits) {
  LoopReport told;
  LoopEvidence& evidence = told.evidence.emplace();
  evidence.prepared.pv.assign(4096, 50.0);
  evidence.prepared.sample_interval_s = 2.0;
  core::signal::DataQuality& quality = evidence.diagnosis.evidence.data_quality;
  const std::string start = "<h3>Data</h3>\n<p>There is no problem with the data.</p>\n";
  EXPECT_EQ(data_section(told).html,
            start +
                "<p class=\"note\">4096 samples at 2 s; missing \u2013, frozen \u2013, op at a "
                "limit \u2013; archive complete, compression factor \u2013, quantisation factor "
                "\u2013; error std \u2013, Harris \u2013 to \u2013, valve travel \u2013 "
                "%/h, \u2013 reversals/h; flags: none.</p>");
  quality.missing_fraction = 0.02;
  quality.frozen_fraction = 0.0;
  quality.saturated_fraction = 0.3;
  quality.compression_factor = 5.0;
  quality.quantisation_factor = 0.25;
  quality.flags = {"pv_held", "short"};
  quality.refusals = {"the setpoint moves too often"};
  core::loop::Performance& work = evidence.diagnosis.evidence.performance;
  work.error_std = 0.5;
  work.harris_low = 0.2;
  work.harris_high = 0.4;
  work.valve_travel_per_h = 120.0;
  work.reversals_per_h = 60.0;
  EXPECT_EQ(
      data_section(told).html,
      start +
          "<p>Tests for nonlinearity refused: the setpoint moves too often.</p>\n"
          "<p class=\"note\">4096 samples at 2 s; missing 2 %, frozen 0 %, op at a limit "
          "30 %; archive complete, compression factor 5, quantisation factor 0.25; error std "
          "0.5 units of pv, Harris 0.2 to 0.4, valve travel 120 %/h, 60 reversals/h; flags: pv "
          "held, short.</p>");
  told.row.pv_unit = "m3/h";
  EXPECT_NE(data_section(told).html.find("error std 0.5 m3/h, Harris"), std::string::npos);
  told.row.pv_unit.clear();
  work.error_std = 1.0;
  EXPECT_NE(data_section(told).html.find("error std 1 unit of pv, Harris"), std::string::npos);
}

}  // namespace
}  // namespace loopscope::daemon
