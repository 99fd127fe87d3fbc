#include "tests/plants/network/evidence_file.hpp"

#include <gtest/gtest.h>
#include <sstream>

namespace loopscope::tests::network {
namespace {

TEST(EvidenceFile, HasALineForEveryMember) {
  Outcome outcome;
  outcome.seed = 7;
  outcome.figures = {{true, {0.5, 1.0, 0.0, 0.25, 1.0, 2.0}}, {false, {}}};
  outcome.none = {0.5, 1.5};
  Outcome outside;
  outside.seed = 7;
  outside.origin = Origin::outside;
  outside.figures = {{false, {}}};
  std::ostringstream text;
  write_evidence(text, {outcome, Outcome{}, outside});
  EXPECT_EQ(text.str(),
            "plant,source,height,setpoint,op,lead,direct,friction,outside,no_leader,cubic\n"
            "valve_7,1,0.5,1,0,0.25,1,2,0,0.5,1.5\n"
            "valve_7,0,0,0,0,0,0,0,0,0.5,1.5\n"
            "outside_7,0,0,0,0,0,0,0,0,0,0\n");
}

}  // namespace
}  // namespace loopscope::tests::network
