#include "daemon/monitor/content_coding.hpp"

#include <gtest/gtest.h>

#include "tests/daemon/monitor/gunzip.hpp"

namespace loopscope::daemon {
namespace {

TEST(ContentCoding, WithoutTheHeaderAnAnswerGoesAsItIs) {
  EXPECT_FALSE(accepted_codings(std::nullopt).prefers_gzip());
  EXPECT_GT(accepted_codings(std::nullopt).identity, 0.0);
  EXPECT_FALSE(accepted_codings("").prefers_gzip());
  EXPECT_GT(accepted_codings("").identity, 0.0);
}

TEST(ContentCoding, GzipIsSentToWhoPrefersIt) {
  for (const char* header :
       {"gzip", "GZIP", "x-gzip", "gzip, deflate, br", "br;q=1.0, gzip;q=0.8, *;q=0.1", "*",
        "gzip;q=0.001", " gzip ; q=0.5 ", "deflate,gzip;Q=1", "gzip,identity;q=0",
        "identity;q=0.5,gzip;q=0.5", "*;q=0.5", "identity;q=0, *", ",,gzip"})
    EXPECT_TRUE(accepted_codings(header).prefers_gzip()) << header;
}

TEST(ContentCoding, NobodyElseGetsIt) {
  for (const char* header : {"identity",
                             "br",
                             "deflate",
                             "gzip;q=0",
                             "gzip;q=0.000",
                             "gzip;q=0, *",
                             "*;q=0",
                             "gzip;q=2",
                             "gzip;q=-1",
                             "gzip;q=x",
                             "gzip;q",
                             "gzip;level=9",
                             "identity, gzip;q=0.5",
                             "gzipped",
                             "my-gzip",
                             "gzip br",
                             "identity;q=0",
                             "x",
                             ";",
                             "gzip;q=nan",
                             "gzip;q=inf"})
    EXPECT_FALSE(accepted_codings(header).prefers_gzip()) << header;
}

TEST(ContentCoding, PlainAnswersAreRefusedByNameOnly) {
  for (const char* header :
       {"identity;q=0", "*;q=0", "gzip, identity;q=0", "gzip, *;q=0", "*;q=0.0"})
    EXPECT_EQ(accepted_codings(header).identity, 0.0) << header;
  for (const char* header : {"gzip", "br", "gzip;q=0", "*;q=0, identity", "identity;q=0.001", "*"})
    EXPECT_GT(accepted_codings(header).identity, 0.0) << header;
}

TEST(ContentCoding, GzipComesBackAsItWas) {
  std::string page;
  for (int loop = 0; loop < 5000; ++loop)
    page += "<tr><td>FC" + std::to_string(loop) + "</td></tr>";
  EXPECT_EQ(gunzip(gzip(page)), page);
  EXPECT_LT(gzip(page).size(), page.size() / 5);
  EXPECT_EQ(gunzip(gzip("")), "");
}

}  // namespace
}  // namespace loopscope::daemon
