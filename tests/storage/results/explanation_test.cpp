#include <gmock/gmock.h>

#include "tests/storage/results/results_fixture.hpp"

/// The steps of the loop model, from finish() to what people read.
namespace loopscope::storage {
namespace {

class ExplanationTest : public ResultsTest {
 protected:
  void SetUp() override {
    ResultsTest::SetUp();
    if (IsSkipped()) return;
    add_loops({"a"});
  }
  /// Finishes the loop's slot 1 with this digest after `change` of its record.
  template <typename Change>
  WriteCount finish(const std::string& digest, Change change) {
    database->execute("UPDATE loopscope.schedule SET visible_at = now()");
    ResultsDatabase results = connect();
    CompletedLoop loop = completed(claim_all(results).at(0), slot(1), digest);
    change(*loop.record);
    return results.finish(std::vector{loop}, {});
  }
  [[nodiscard]] TextRows rows(const std::string& sql) const { return database->rows(sql); }
};

TEST_F(ExplanationTest, EveryStepIsARow) {
  finish("d1", [](AnalysisRecord& record) { explain(record); });
  EXPECT_EQ(
      rows("SELECT step, effect, parameters->>'S', parameters->>'law', intervals->'S'->>1,"
           " holdout_error_before, holdout_error_after, evidence, p, margin, simulation_ratio,"
           " steadiness, statement FROM loopscope.explanation_step ORDER BY step"),
      (TextRows{{"1", "valve_stiction", "4.2", "kano", "4.4", "1", "0.30000000000000004", "812.5",
                 "1e-300", "90", "0.5", "0.75", "The valve's \"stem\" sticks."},
                {"2", "external_oscillation", "NULL", "NULL", "NULL", "0.5", "0.25", "12", "0.001",
                 "NULL", "NULL", "1", "A sinusoid enters."}}));
}

TEST_F(ExplanationTest, AStepSaysWhichTestsAskedForIt) {
  finish("d1", [](AnalysisRecord& record) { explain(record); });
  EXPECT_EQ(rows("SELECT step, test->>'test', (test->>'p')::float8, (test->>'p_after')::float8,"
                 " test->>'statement' FROM loopscope.explanation"
                 " CROSS JOIN jsonb_array_elements(asked_by) AS test ORDER BY step, 3"),
            (TextRows{{"1", "op_direction", "1e-300", "0.31", "Errors \"follow\" op."},
                      {"1", "op_level", "0.004", "NULL", ""}}));
  EXPECT_EQ(value("SELECT asked_by FROM loopscope.explanation_step WHERE step = 2"), "[]")
      << "no test asked for the sinusoid";
  EXPECT_EQ(value("SELECT model->'asked'->0->>'test' FROM loopscope.analysis"), "op_direction");
}

/// A worker of the version before is still at work: it does not say, so nothing is claimed.
TEST_F(ExplanationTest, AModelThatDoesNotSayWhatAskedLeavesItUnknown) {
  finish("d1", [](AnalysisRecord& record) {
    explain(record);
    record.model_json = R"({"steps": [{"effect": "load_step", "parameters": {}, "intervals": {},
                                       "statement": "A load step."}]})";
  });
  EXPECT_EQ(rows("SELECT effect, asked_by FROM loopscope.explanation_step"),
            (TextRows{{"load_step", "NULL"}}));
}

TEST_F(ExplanationTest, AnErrorThatIsNoNumberIsNullAndStopsNothing) {
  EXPECT_EQ(finish("d1", [](AnalysisRecord& record) { explain(record, "null"); }).inserted, 1U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.explanation_step WHERE holdout_error_after"
                  " IS NULL"),
            "1");
}

TEST_F(ExplanationTest, LateDataKeepTheFormerSteps) {
  finish("d1", [](AnalysisRecord& record) { explain(record); });
  EXPECT_EQ(finish("d2", [](AnalysisRecord&) {}).revised, 1U);
  EXPECT_EQ(rows("SELECT input_revision, count(*) FROM loopscope.explanation_step GROUP BY 1"),
            (TextRows{{"1", "2"}}));
  EXPECT_EQ(rows("SELECT input_revision, effects FROM loopscope.loop_history ORDER BY 1"),
            (TextRows{{"1", "{valve_stiction,external_oscillation}"}, {"2", "{}"}}));
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.explanation"), "0")
      << "the newest analysis needs no effect";
  EXPECT_EQ(value("SELECT model FROM loopscope.analysis"), "NULL");
  finish("d3", [](AnalysisRecord& record) { explain(record); });
  EXPECT_EQ(rows("SELECT input_revision, step FROM loopscope.explanation ORDER BY step"),
            (TextRows{{"3", "1"}, {"3", "2"}}));
}

TEST_F(ExplanationTest, ARepeatWritesNoSecondStep) {
  const auto with_model = [](AnalysisRecord& record) { explain(record); };
  finish("d1", with_model);
  EXPECT_EQ(finish("d1", with_model).unchanged, 1U);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.explanation_step"), "2");
}

TEST_F(ExplanationTest, ABrokenModelStoresNothingOfTheAnalysis) {
  EXPECT_THROW(finish("d1", [](AnalysisRecord& record) { record.model_json = "{"; }),
               DatabaseError);
  EXPECT_EQ(value("SELECT count(*) FROM loopscope.analysis"), "0");
}

TEST_F(ExplanationTest, PeopleReadTheStoryOfALoop) {
  finish("d1", [](AnalysisRecord& record) { explain(record); });
  EXPECT_EQ(rows("SELECT step, effect, error_ratio, code FROM loopscope.explanation"
                 " WHERE loop_name = 'a' ORDER BY step"),
            (TextRows{{"1", "valve_stiction", "0.30000000000000004", "valve_stiction"},
                      {"2", "external_oscillation", "0.5", "valve_stiction"}}));
}

}  // namespace
}  // namespace loopscope::storage
