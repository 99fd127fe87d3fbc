#include "storage/historian/quality_sql.hpp"

#include <gmock/gmock.h>

#include "tests/storage/historian/historian_fixture.hpp"

namespace loopscope::storage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

/// A table with one row per code, the number of the code as the value.
class QualityTest : public HistorianTest {
 protected:
  void codes(const std::string& type, const std::string& list) {
    database->execute(
        "CREATE TABLE judged AS SELECT 'a'::text AS tag,"
        " timestamptz '2026-01-01 00:00:00+00' + k * interval '1 s' AS time,"
        " k::float8 AS value, q::" +
        type + " AS quality FROM unnest(ARRAY[" + list +
        "]) WITH ORDINALITY AS t (q, k); CREATE INDEX ON judged (tag, time)");
    layout.relation = "judged";
  }
  core::signal::RawSeries read(QualityRule rule) {
    layout.quality.rule = rule;
    HistorianReader historian = reader();
    return read_one(historian, request("a", 0, 99));
  }
};

TEST_F(QualityTest, OpcDaGoesByTheUpperBitsOfTheLowByte) {
  codes("int4", "192, 216, 195, 64, 0, 24, 128, NULL, 65728");
  EXPECT_THAT(read(QualityRule::opcda).value,
              ElementsAre(1, 2, 3, IsNan(), IsNan(), IsNan(), IsNan(), IsNan(), 9));
  EXPECT_EQ(read(QualityRule::opcda).unknown_quality, 2U) << "128 and NULL";
  layout.quality.accept_uncertain = true;
  EXPECT_EQ(read(QualityRule::opcda).value[3], 4.0);
  EXPECT_THAT(read(QualityRule::opcda_exact).value[1], IsNan());
}

TEST_F(QualityTest, OpcUaIsNegativeInFourBytesAndInterpolatedValuesAreNoData) {
  // Good, good with limit bits, interpolated, raw, uncertain, bad as int4, bad as int8, reserved.
  codes("int8", "0, 256, 1026, 1024, 1073741824, -2147483648, 2147483648, 3221225472");
  const auto rows = read(QualityRule::opcua);
  EXPECT_THAT(rows.value, ElementsAre(1, 2, IsNan(), 4, IsNan(), IsNan(), IsNan(), IsNan()));
  EXPECT_EQ(rows.unknown_quality, 1U);
}

TEST_F(QualityTest, OpcHdaLeavesOutWhatTheServerMadeUp) {
  codes("int4", "192, 131264, 262336, 524480");
  EXPECT_THAT(read(QualityRule::opchda).value, ElementsAre(1, IsNan(), 3, IsNan()));
}

TEST_F(QualityTest, TruthsWordsAndZeros) {
  codes("text", "'Good', 'good ', 'Bad', 'Stale', NULL");
  layout.quality.good = {"Good"};
  layout.quality.bad = {"Bad"};
  const auto rows = read(QualityRule::codes);
  EXPECT_THAT(rows.value, ElementsAre(1, 2, IsNan(), IsNan(), IsNan()));
  EXPECT_EQ(rows.unknown_quality, 2U) << "Stale and NULL";
}

TEST_F(QualityTest, BooleanColumns) {
  codes("bool", "true, false, NULL");
  const auto rows = read(QualityRule::truth);
  EXPECT_THAT(rows.value, ElementsAre(1, IsNan(), IsNan()));
  EXPECT_EQ(rows.unknown_quality, 1U);
}

TEST_F(QualityTest, ARuleThatDoesNotFitTheColumnIsRefused) {
  codes("text", "'Good'");
  const auto refusal = [&](QualityRule rule) {
    try {
      read(rule);
      return std::string("accepted");
    } catch (const DatabaseError& error) {
      return error.what() + std::string(" HINT: ") + error.hint();
    }
  };
  EXPECT_THAT(refusal(QualityRule::opcda), HasSubstr("has the type text"));
  EXPECT_THAT(refusal(QualityRule::truth), HasSubstr("to codes for texts"));
  layout.quality.names = SideTable{"public.nothing", "name", "id"};
  EXPECT_THAT(refusal(QualityRule::codes), HasSubstr("no such table: public.nothing"));
}

}  // namespace
}  // namespace loopscope::storage
