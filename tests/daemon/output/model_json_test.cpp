#include "daemon/output/model_json.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace loopscope::daemon {
namespace {

using Json = nlohmann::ordered_json;
using core::model::Explanation;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Explanation sticking() {
  core::model::Step step;
  step.effect = core::model::EffectKind::valve_stiction;
  step.parameters = {{"S", "%", 4.2, 4.0, 4.4}, {"J", "%", 1.1, {}, {}}};
  step.law = "kano";
  step.holdout_error_before = 1.0;
  step.holdout_error_after = 0.5;
  step.evidence = 300.0;
  step.p = 1e-9;
  step.margin = 42.0;
  step.statement = "The valve sticks.";
  step.asked_by = {{"op_direction", 1e-30, 0.31, "Errors follow the direction of op."},
                   {"op_level", 1e-4, {}, ""}};
  step.promise_rank = 2;
  Explanation explanation;
  explanation.excited = true;
  explanation.excitation = "op moves by 3 %.";
  explanation.noise_floor = 0.4;
  explanation.baseline = {"first order", 1.0, {false, 2.0, 20.0, 0.0, 5.0}};
  explanation.steps = {step};
  explanation.asked = {{core::model::EffectKind::load_step, "time_event", 1e-40},
                       {core::model::EffectKind::valve_stiction, "op_direction", 1e-30}};
  explanation.unexplained = {0.1, 0.3, 0.2, "Nothing is left."};
  explanation.questions = {{"periodic", 0.7, ""}};
  explanation.closed_loop = {0.5, 30.0, 0.9, 1.5, 0.7, 60.0, 150.0};
  return explanation;
}

void expect_same_keys(const Json& left, const Json& right, const std::string& where) {
  for (const auto& [key, value] : left.items()) {
    ASSERT_TRUE(right.contains(key)) << where << "/" << key;
    if (value.is_object() && key != "closed_loop") {
      expect_same_keys(value, right[key], where + "/" + key);
    }
  }
  EXPECT_EQ(left.size(), right.size()) << where;
}

TEST(ModelJson, TellsTheWholeStory) {
  const Json json = model_json(sticking());
  EXPECT_EQ(json["excited"], true);
  EXPECT_EQ(json["error_kind"], "one_step");
  EXPECT_EQ(json["noise_floor"], 0.4);
  EXPECT_EQ(json["baseline"]["description"], "first order");
  EXPECT_EQ(json["baseline"]["holdout_error"], 1.0);
  EXPECT_EQ(json["baseline"]["process"]["time_constant_s"], 20.0);
  const Json& step = json["steps"].at(0);
  EXPECT_EQ(step["effect"], "valve_stiction");
  EXPECT_EQ(step["parameters"].dump(), R"({"S":4.2,"J":1.1,"law":"kano"})");
  EXPECT_EQ(step["intervals"].dump(), R"({"S":[4.0,4.4]})") << "J has none";
  EXPECT_EQ(step["holdout_error_before"], 1.0);
  EXPECT_EQ(step["holdout_error_after"], 0.5);
  EXPECT_EQ(step["evidence"], 300.0);
  EXPECT_EQ(step["p"], 1e-9);
  EXPECT_TRUE(step["simulation_ratio"].is_null());
  EXPECT_EQ(json["unexplained"]["ngi_p"], 0.2);
  EXPECT_EQ(json["questions"].at(0)["name"], "periodic");
  EXPECT_EQ(json["closed_loop"]["stable"], true);
  EXPECT_EQ(json["closed_loop"]["peak_sensitivity"], 1.5);
}

TEST(ModelJson, SaysWhichTestAskedForWhat) {
  const Json json = model_json(sticking());
  const Json& step = json["steps"].at(0);
  EXPECT_EQ(step["asked_by"].dump(),
            R"([{"test":"op_direction","p":1e-30,"p_after":0.31,"statement":)"
            R"("Errors follow the direction of op."},)"
            R"({"test":"op_level","p":0.0001,"p_after":null,"statement":""}])");
  EXPECT_EQ(step["promise_rank"], 2);
  EXPECT_EQ(json["asked"].dump(),
            R"([{"effect":"load_step","test":"time_event","p":1e-40},)"
            R"({"effect":"valve_stiction","test":"op_direction","p":1e-30}])");
}

TEST(ModelJson, AStepThatNoTestAskedForHasAnEmptyList) {
  Explanation explanation = sticking();
  explanation.steps[0].asked_by.clear();
  explanation.steps[0].promise_rank = 0;
  explanation.asked.clear();
  const Json json = model_json(explanation);
  EXPECT_EQ(json["steps"][0]["asked_by"], Json::array());
  EXPECT_EQ(json["steps"][0]["promise_rank"], 0);
  EXPECT_EQ(json["asked"], Json::array());
}

TEST(ModelJson, WithoutAModelTheKeysStayAndKnowNothing) {
  const Json none = model_json(std::nullopt);
  expect_same_keys(none, model_json(sticking()), "");
  EXPECT_EQ(none["steps"], Json::array());
  EXPECT_EQ(none["asked"], Json::array());
  EXPECT_TRUE(none["error_kind"].is_null());
  EXPECT_TRUE(none["excited"].is_null());
  EXPECT_TRUE(none["unexplained"]["fraction"].is_null());
  EXPECT_TRUE(none["baseline"]["process"]["gain"].is_null());
}

TEST(ModelJson, WhatIsNoFiniteNumberIsNull) {
  Explanation explanation = sticking();
  explanation.closed_loop->peak_sensitivity = kInfinite;
  explanation.steps[0].holdout_error_after = std::numeric_limits<double>::quiet_NaN();
  explanation.steps[0].parameters[0].value = -kInfinite;
  explanation.steps[0].parameters[0].high = kInfinite;
  const Json json = Json::parse(model_json(explanation).dump());
  EXPECT_EQ(json["closed_loop"]["stable"], false);
  EXPECT_TRUE(json["closed_loop"]["peak_sensitivity"].is_null());
  EXPECT_TRUE(json["steps"][0]["holdout_error_after"].is_null());
  EXPECT_TRUE(json["steps"][0]["parameters"]["S"].is_null());
  EXPECT_EQ(json["steps"][0]["intervals"]["S"].dump(), "[4.0,null]");
}

}  // namespace
}  // namespace loopscope::daemon
