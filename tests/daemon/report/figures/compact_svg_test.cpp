#include "daemon/report/figures/compact_svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(CompactSvg, KeepsTheRootAndWhatIsDrawn) {
  const std::string svg = compact_svg(
      "<?xml version=\"1.0\"?>\n<!DOCTYPE svg>\n<svg \n width=\"5\">\n<title>Gnuplot</title>\n"
      "<desc>x</desc>\n<g id=\"c\">\n<defs><path stroke='currentColor'/></defs>\n"
      "<g fill=\"none\" color=\"red\">\n</g>\n"
      "<g color=\"red\">\n\t<path stroke='currentColor' d='M64.01,130.15 L59.51,-0.04\n\t L1,2 "
      "Z'/></g>\n<g><text font-family=\"Arial\" >a b</text></g>\n</g></svg>");
  EXPECT_TRUE(svg.starts_with("<svg font-family=")) << svg;
  EXPECT_THAT(svg, HasSubstr("d='M64,130.2L59.5,0L1,2Z'"));
  EXPECT_THAT(svg, HasSubstr("a b</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("currentColor")));
  EXPECT_THAT(svg, Not(HasSubstr("<defs>")));
  EXPECT_THAT(svg, Not(HasSubstr("fill=\"none\"")));
  EXPECT_THAT(svg, HasSubstr("<g id=\"c\">"));
}

TEST(CompactSvg, WhatIsNoPictureStaysEmpty) {
  EXPECT_EQ(compact_svg(""), "");
  EXPECT_EQ(compact_svg("no picture"), "");
}

TEST(SvgUri, FitsIntoAnAttributeInDoubleQuotes) {
  EXPECT_EQ(svg_uri("<g a=\"#1\">5% & x</g>").html,
            "data:image/svg+xml,%3Cg%20a='%231'%3E5%25%20%26%20x%3C/g%3E");
}

}  // namespace
}  // namespace loopscope::daemon
