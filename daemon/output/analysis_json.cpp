#include "daemon/output/analysis_json.hpp"

#include <optional>

#include "daemon/output/model_json.hpp"

namespace loopscope::daemon {
namespace {

using Json = nlohmann::ordered_json;

Json input_json(const InputFacts& input) {
  return {{"file", input.file},
          {"samples", input.samples},
          {"interval_s", number_or_null(input.interval_s)},
          {"start", input.start},
          {"end", input.end}};
}

Json quality_json(const core::signal::DataQuality& quality) {
  return {{"usable", quality.usable},
          {"reason", quality.usable ? Json(nullptr) : Json(quality.reason)},
          {"flags", quality.flags},
          {"repeated_times", quality.repeated_times},
          {"missing_fraction", number_or_null(quality.missing_fraction)},
          {"frozen_fraction", number_or_null(quality.frozen_fraction)},
          {"drawn_fraction", number_or_null(quality.drawn_fraction)},
          {"archive", core::signal::name(quality.archive)},
          {"refusals", quality.refusals},
          {"compression_factor", number_or_null(quality.compression_factor)},
          {"quantisation_factor", number_or_null(quality.quantisation_factor)},
          {"saturated_fraction", number_or_null(quality.saturated_fraction)}};
}

Json peaks_json(const std::vector<core::hos::Peak>& peaks) {
  Json list = Json::array();
  for (const core::hos::Peak& peak : peaks) {
    list.push_back(
        {{"f1", peak.f1}, {"f2", peak.f2}, {"bic2", peak.bic2}, {"p", number_or_null(peak.p)}});
  }
  return list;
}

/// What drives the loop, and how it differs from normal noise of one loudness.
Json noise_json(const std::optional<core::hos::NoiseShape>& noise) {
  if (!noise) return nullptr;
  Json loudest = nullptr;
  if (noise->loudest_size > 0) {
    loudest = {{"first_sample", noise->loudest_first + 1},
               {"last_sample", noise->loudest_first + noise->loudest_size},
               {"ratio", noise->loudest_ratio}};
  }
  return {{"excess_kurtosis", noise->excess_kurtosis},
          {"heavy_tails_p", noise->tails_p},
          {"variance_changes_p", noise->variance_p},
          {"loudest", loudest}};
}

Json hos_json(const core::hos::Result& hos, core::TestedOn tested_on) {
  return {{"segments", hos.segments},
          {"bifrequencies", hos.bifrequencies},
          {"mean_bic2", hos.mean_bic2},
          {"std_bic2", hos.std_bic2},
          {"max_bic2", hos.max_bic2},
          {"critical_mean_bic2", hos.critical_mean_bic2},
          {"ngi", hos.ngi},
          {"nli", hos.nli},
          {"published", {{"gaussian", hos.published.gaussian}, {"linear", hos.published.linear}}},
          {"skewness", hos.skewness},
          {"excess_kurtosis", hos.excess_kurtosis},
          {"ngi_p", number_or_null(hos.ngi_p)},
          {"nli_p", number_or_null(hos.nli_p)},
          {"cubic_p", number_or_null(hos.cubic_p)},
          {"nonlinear_p", number_or_null(hos.nonlinear_p)},
          {"innovation_p", number_or_null(hos.innovation_p)},
          {"tested_on", core::name(tested_on)},
          {"noise", noise_json(hos.noise)},
          {"coupling", core::hos::name(hos.coupling)},
          {"peaks", peaks_json(hos.peaks)}};
}

/// The same keys with null for a window whose statistics were not computed.
Json empty_hos_json() {
  Json object = hos_json({}, core::TestedOn::error);
  for (auto& [key, value] : object.items()) value = nullptr;
  object["published"] = {{"gaussian", nullptr}, {"linear", nullptr}};
  object["peaks"] = Json::array();
  return object;
}

Json oscillation_json(const core::loop::Oscillation& oscillation) {
  return {{"present", oscillation.present},
          {"period_s", number_or_null(oscillation.period_s)},
          {"regularity", number_or_null(oscillation.regularity)},
          {"amplitude", number_or_null(oscillation.amplitude)},
          {"persistence", number_or_null(oscillation.persistence)},
          {"p", number_or_null(oscillation.p)}};
}

Json performance_json(const core::loop::Performance& performance) {
  return {{"harris_low", number_or_null(performance.harris_low)},
          {"harris_high", number_or_null(performance.harris_high)},
          {"harris_p", number_or_null(performance.harris_p)},
          {"error_std", number_or_null(performance.error_std)},
          {"error_log_variance_se", number_or_null(performance.error_log_variance_se)},
          {"valve_travel_per_h", number_or_null(performance.valve_travel_per_h)},
          {"reversals_per_h", number_or_null(performance.reversals_per_h)},
          {"auto_fraction", number_or_null(performance.auto_fraction)},
          {"at_limit_fraction", number_or_null(performance.at_limit_fraction)}};
}

Json shape_json(const core::Evidence& evidence) {
  const core::loop::Shape& shape = evidence.shape;
  return {{"horch_dtau", number_or_null(shape.horch_dtau)},
          {"horch_drho", number_or_null(shape.horch_drho)},
          {"shape_index", number_or_null(shape.shape_index)},
          {"ellipse_stiction", number_or_null(shape.ellipse_stiction)},
          {"ellipse_r2", number_or_null(shape.ellipse_r2)},
          {"mv_op_width", number_or_null(shape.mv_op_width)},
          {"mv_slip_jump", number_or_null(shape.mv_slip_jump)},
          {"mv_stuck_fraction", number_or_null(shape.mv_stuck_fraction)},
          {"op_span_percent", number_or_null(evidence.valve_gain.op_span_percent)},
          {"pv_relative_span", number_or_null(evidence.valve_gain.pv_relative_span)},
          {"pv_span_percent", number_or_null(evidence.valve_gain.pv_span_percent)}};
}

}  // namespace

Json verdict_json(const core::diagnosis::Verdict& verdict) {
  Json causes = Json::array();
  for (const core::diagnosis::CauseReport& cause : verdict.causes) {
    causes.push_back({{"code", core::diagnosis::name(cause.code)},
                      {"probability", cause.probability},
                      {"prior", cause.prior},
                      {"for", cause.in_favour},
                      {"against", cause.against}});
  }
  return {{"code", core::diagnosis::name(verdict.code)},
          {"confidence", verdict.confidence},
          {"p", number_or_null(verdict.p)},
          {"summary", verdict.summary},
          {"reasons", verdict.reasons},
          {"action", verdict.action},
          {"causes", std::move(causes)}};
}

Json slow_look_json(const core::hos::SlowLook& look, core::TestedOn tested_on) {
  Json object = hos_json(look.result, tested_on);
  object["decimation"] = look.decimation;
  object["samples"] = look.samples;
  return object;
}

Json analysis_json(const InputFacts& input, const core::Diagnosis& diagnosis) {
  const core::Evidence& evidence = diagnosis.evidence;
  return {{"input", input_json(input)},
          {"data_quality", quality_json(evidence.data_quality)},
          {"hos", evidence.hos ? hos_json(*evidence.hos, evidence.tested_on) : empty_hos_json()},
          {"hos_slow", evidence.hos_slow ? slow_look_json(*evidence.hos_slow, evidence.tested_on)
                                         : Json(nullptr)},
          {"oscillation", oscillation_json(evidence.oscillation)},
          {"performance", performance_json(evidence.performance)},
          {"shape", shape_json(evidence)},
          {"model", model_json(evidence.model)},
          {"verdict", verdict_json(diagnosis.verdict)}};
}

std::string json_text(const nlohmann::ordered_json& object) {
  constexpr int kIndent = 2;
  return object.dump(kIndent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace loopscope::daemon
