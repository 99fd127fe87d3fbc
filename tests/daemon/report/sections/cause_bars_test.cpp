#include "daemon/report/sections/cause_bars.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "daemon/report/text/html_text.hpp"
#include "tests/daemon/report/markup.hpp"
#include "tests/support/hostile_names.hpp"

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
  const std::string page = cause_bars(verdict).html;
  EXPECT_THAT(page, HasSubstr("<rect fill=\"#b34700\" width=\"83\""));
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
  EXPECT_THAT(cause_bars(verdict).html, Not(HasSubstr("nonlinear")));
  verdict.code = VerdictCode::nonlinear_unexplained;
  EXPECT_THAT(cause_bars(verdict).html, HasSubstr("nonlinear"));
}

TEST(CauseBars, WithoutCausesThereIsNothing) {
  EXPECT_EQ(cause_bars({}).html, "");
}

TEST(CauseBars, NoHostileReasonChangesTheMarkup) {
  const auto bars_with = [](const std::string& text) {
    Verdict verdict;
    verdict.causes = {{VerdictCode::valve_stiction, 0.8, 0.15, {text}, {text, text}}};
    return cause_bars(verdict).html;
  };
  for (const auto& [about, name] : tests::hostile_names()) {
    EXPECT_EQ(tags_of(bars_with(name)), tags_of(bars_with("words"))) << about << ": " << name;
    EXPECT_THAT(bars_with(name), HasSubstr("<li>" + html(name) + "</li>")) << about;
  }
}

}  // namespace
}  // namespace loopscope::daemon
