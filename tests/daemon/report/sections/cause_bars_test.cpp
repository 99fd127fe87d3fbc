#include "daemon/report/sections/cause_bars.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace loopscope::daemon {
namespace {

using core::diagnosis::Verdict;
using core::diagnosis::VerdictCode;
using testing::HasSubstr;
using testing::Not;

TEST(CauseBars, ABarIsAsLongAsItsCauseIsProbable) {
  Verdict verdict;
  verdict.causes = {{VerdictCode::valve_stiction,
                     0.826,
                     0.15,
                     {"op repeats its half cycle: 93 % (odds times 3)"},
                     {}},
                    {VerdictCode::tight_tuning, 0.2, 0.1, {}, {"a <b> & more"}},
                    {VerdictCode::healthy, 0.01, 0.2, {"never shown"}, {}}};
  const std::string page = cause_bars(verdict);
  EXPECT_THAT(page, HasSubstr("<rect class=\"valve_stiction\" width=\"83\""));
  EXPECT_THAT(page, HasSubstr("<span class=\"share\">20 %</span>"));
  EXPECT_THAT(page, HasSubstr("<p>For</p><ul><li>op repeats its half cycle: 93 % (odds times 3)"));
  EXPECT_THAT(page, HasSubstr("<p>Against</p><ul><li>a &lt;b&gt; &amp; more</li></ul>"));
  EXPECT_THAT(page, Not(HasSubstr("never shown")));
}

TEST(CauseBars, AnyNonlinearityIsShownWhereItIsTheVerdict) {
  Verdict verdict;
  verdict.code = VerdictCode::valve_stiction;
  verdict.causes = {{VerdictCode::nonlinear_unexplained, 0.9, 0.5, {}, {}},
                    {VerdictCode::valve_stiction, 0.6, 0.15, {}, {}}};
  EXPECT_THAT(cause_bars(verdict), Not(HasSubstr("nonlinear")));
  verdict.code = VerdictCode::nonlinear_unexplained;
  EXPECT_THAT(cause_bars(verdict), HasSubstr("nonlinear"));
}

TEST(CauseBars, WithoutCausesThereIsNothing) {
  EXPECT_EQ(cause_bars({}), "");
}

}  // namespace
}  // namespace loopscope::daemon
