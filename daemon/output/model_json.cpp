#include "daemon/output/model_json.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "storage/results/writes/model_keys.hpp"

namespace loopscope::daemon {
namespace {

using Json = nlohmann::ordered_json;
using namespace core::model;
namespace keys = storage::model_keys;

Json process_json(const ProcessFit& process) {
  return {{"integrating", process.integrating},
          {"gain", number_or_null(process.gain)},
          {"time_constant_s", number_or_null(process.time_constant_s)},
          {"second_time_constant_s", number_or_null(process.second_time_constant_s)},
          {"delay_s", number_or_null(process.delay_s)}};
}

Json baseline_json(const Baseline& baseline) {
  return {{"description", baseline.description},
          {"holdout_error", number_or_null(baseline.holdout_error)},
          {"process", process_json(baseline.process)}};
}

Json parameters_json(const Step& step) {
  Json object = Json::object();
  for (const Parameter& parameter : step.parameters) {
    object[std::string(parameter.name)] = number_or_null(parameter.value);
  }
  if (!step.law.empty()) object["law"] = step.law;
  return object;
}

Json intervals_json(const Step& step) {
  Json object = Json::object();
  for (const Parameter& parameter : step.parameters) {
    if (!parameter.low && !parameter.high) continue;
    object[std::string(parameter.name)] =
        Json::array({number_or_null(parameter.low), number_or_null(parameter.high)});
  }
  return object;
}

Json asked_by_json(const Step& step) {
  Json list = Json::array();
  for (const AskedBy& by : step.asked_by) {
    list.push_back({{"test", by.test},
                    {"p", number_or_null(by.p)},
                    {"p_after", number_or_null(by.p_after)},
                    {"statement", by.statement}});
  }
  return list;
}

Json step_json(const Step& step) {
  return {{keys::kEffect, name(step.effect)},
          {keys::kParameters, parameters_json(step)},
          {keys::kIntervals, intervals_json(step)},
          {keys::kErrorBefore, number_or_null(step.holdout_error_before)},
          {keys::kErrorAfter, number_or_null(step.holdout_error_after)},
          {keys::kEvidence, number_or_null(step.evidence)},
          {keys::kP, number_or_null(step.p)},
          {keys::kMargin, number_or_null(step.margin)},
          {keys::kSimulationRatio, number_or_null(step.simulation_ratio)},
          {keys::kSteadiness, number_or_null(step.steadiness)},
          {keys::kStatement, step.statement},
          {keys::kAskedBy, asked_by_json(step)},
          {"promise_rank", step.promise_rank}};
}

Json asked_json(const std::vector<AskedEffect>& asked) {
  Json list = Json::array();
  for (const AskedEffect& one : asked) {
    list.push_back(
        {{"effect", name(one.effect)}, {"test", one.test}, {"p", number_or_null(one.p)}});
  }
  return list;
}

Json unexplained_json(const Unexplained& rest) {
  return {{"fraction", number_or_null(rest.fraction)},
          {"whiteness_p", number_or_null(rest.whiteness_p)},
          {"ngi_p", number_or_null(rest.ngi_p)},
          {"statement", rest.statement}};
}

Json questions_json(const std::vector<Question>& questions) {
  Json list = Json::array();
  for (const Question& question : questions) {
    list.push_back({{"name", question.name},
                    {"p", number_or_null(question.p)},
                    {"statement", question.statement}});
  }
  return list;
}

Json closed_loop_json(const ClosedLoop& loop) {
  return {{"stable", std::isfinite(loop.peak_sensitivity)},
          {keys::kControllerGain, number_or_null(loop.controller_gain)},
          {keys::kIntegralTime, number_or_null(loop.integral_time_s)},
          {keys::kControllerFit, number_or_null(loop.controller_fit)},
          {"peak_sensitivity", number_or_null(loop.peak_sensitivity)},
          {"damping", number_or_null(loop.damping)},
          {"period_s", number_or_null(loop.period_s)},
          {"settling_s", number_or_null(loop.settling_s)}};
}

Json explanation_json(const Explanation& explanation) {
  Json steps = Json::array();
  for (const Step& step : explanation.steps) steps.push_back(step_json(step));
  return {{"excited", explanation.excited},
          {"excitation", explanation.excitation},
          {"process_doubt", explanation.process_doubt},
          {"error_kind", name(explanation.error_kind)},
          {"noise_floor", number_or_null(explanation.noise_floor)},
          {"baseline", baseline_json(explanation.baseline)},
          {"asked", asked_json(explanation.asked)},
          {keys::kSteps, std::move(steps)},
          {"unexplained", unexplained_json(explanation.unexplained)},
          {"questions", questions_json(explanation.questions)},
          {keys::kClosedLoop,
           explanation.closed_loop ? closed_loop_json(*explanation.closed_loop) : Json(nullptr)}};
}

/// `object` with every figure and word replaced by null; objects within keep their keys.
void make_null(Json& object) {
  for (auto& [key, value] : object.items()) {
    if (value.is_object()) {
      make_null(value);
    } else if (!value.is_array()) {
      value = nullptr;
    }
  }
}

}  // namespace

Json model_json(const std::optional<Explanation>& explanation) {
  if (explanation) return explanation_json(*explanation);
  Json object = explanation_json({});
  make_null(object);
  return object;
}

}  // namespace loopscope::daemon
