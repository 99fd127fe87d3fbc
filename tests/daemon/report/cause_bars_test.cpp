#include "daemon/report/cause_bars.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::daemon {
namespace {

using core::diagnosis::CauseReport;
using core::diagnosis::VerdictCode;
using testing::HasSubstr;
using testing::Not;

TEST(CauseBars, ABarIsAsLongAsItsCauseIsProbable) {
  const std::vector<CauseReport> causes = {
      {VerdictCode::valve_stiction,
       0.826,
       0.15,
       {"op repeats its half cycle: 93 % (odds times 3)"},
       {}},
      {VerdictCode::tight_tuning, 0.2, 0.1, {}, {"a <b> & more"}},
      {VerdictCode::healthy, 0.01, 0.2, {"never shown"}, {}}};
  const std::string page = cause_bars(causes);
  EXPECT_THAT(page, HasSubstr("<rect class=\"valve_stiction\" width=\"83\""));
  EXPECT_THAT(page, HasSubstr("<span class=\"share\">20 %</span>"));
  EXPECT_THAT(page, HasSubstr("<p>For</p><ul><li>op repeats its half cycle: 93 % (odds times 3)"));
  EXPECT_THAT(page, HasSubstr("<p>Against</p><ul><li>a &lt;b&gt; &amp; more</li></ul>"));
  EXPECT_THAT(page, Not(HasSubstr("never shown")));
}

TEST(CauseBars, WithoutCausesThereIsNothing) {
  EXPECT_EQ(cause_bars({}), "");
}

}  // namespace
}  // namespace loopscope::daemon
