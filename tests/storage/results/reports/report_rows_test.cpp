#include "storage/results/reports/report_rows.hpp"

#include <gmock/gmock.h>

#include "storage/results/reports/report_database.hpp"
#include "tests/storage/results/views_fixture.hpp"

namespace loopscope::storage {
namespace {

using core::diagnosis::VerdictCode;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

class WhatIfTest : public ViewsTest {};

TEST_F(WhatIfTest, WhatOtherThresholdsWouldFlag) {
  tell({{.loop = "fact"},
        {.loop = "chance", .p = 0.04, .nonlinear_p = 0.04},
        {.loop = "unsure", .confidence = 0.2},
        {.loop = "fine", .code = VerdictCode::healthy, .nonlinear_p = 0.8}});
  const auto changes = [this](std::optional<double> rate, std::optional<int> dependence,
                              std::optional<double> confidence) {
    std::vector<std::string> words;
    for (const WhatIfRow& row :
         ReportDatabase(settings_for(*database)).what_if(rate, dependence, confidence))
      words.push_back(row.change + " " + row.flagged.loop_name);
    return words;
  };
  EXPECT_THAT(changes({}, {}, {}), ElementsAre("kept fact"));
  EXPECT_THAT(changes(0.1, {}, {}), UnorderedElementsAre("kept fact", "gained chance"));
  EXPECT_THAT(changes(0.1, 1, {}), ElementsAre("kept fact"));
  EXPECT_THAT(changes({}, {}, 0.1), UnorderedElementsAre("kept fact", "gained unsure"));
  connect().set_parameter("min_confidence", 0.1);
  EXPECT_THAT(changes({}, {}, 0.3), ElementsAre("kept fact", "lost unsure"));
}

}  // namespace
}  // namespace loopscope::storage
