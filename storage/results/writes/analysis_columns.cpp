#include "storage/results/writes/analysis_columns.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "storage/array_literal.hpp"
#include "storage/results/writes/control_columns.hpp"
#include "storage/results/writes/hos_columns.hpp"

namespace loopscope::storage {
namespace {

using core::hos::Result;

const AnalysisRecord& record(const CompletedLoop& loop) {
  return *loop.record;
}

void add_optional_text(ArrayLiteral& array, std::string_view text) {
  text.empty() ? array.add_null() : array.add_text(text);
}

/// A figure of one part of the evidence: &Evidence::shape, &Shape::horch_dtau.
template <auto part, auto member>
void add_figure(ArrayLiteral& array, const CompletedLoop& loop) {
  array.add_number(evidence(loop).*part.*member);
}

using core::Evidence;
using core::loop::Oscillation;
using core::loop::Performance;
using core::loop::Shape;
using core::signal::ControlState;
using core::signal::DataQuality;

template <auto member>
constexpr auto quality = add_figure<&Evidence::data_quality, member>;
template <auto member>
constexpr auto oscillation = add_figure<&Evidence::oscillation, member>;
template <auto member>
constexpr auto performance = add_figure<&Evidence::performance, member>;
template <auto member>
constexpr auto shape = add_figure<&Evidence::shape, member>;

using core::model::Explanation;

/// A figure that `read` takes from the loop model; NULL when there is none.
template <auto read>
void add_model(ArrayLiteral& array, const CompletedLoop& loop) {
  const std::optional<Explanation>& model = evidence(loop).model;
  model ? array.add_number(read(*model)) : array.add_null();
}

const std::array kColumns{
    AnalysisColumn{"loop_id", "bigint",
                   [](ArrayLiteral& a, const CompletedLoop& l) { a.add_integer(l.loop_id); }},
    AnalysisColumn{
        "slot_end", "timestamptz",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).slot_end_us); }},
    AnalysisColumn{"algorithm_revision", "integer",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     a.add_integer(record(l).algorithm_revision);
                   }},
    AnalysisColumn{"fence", "bigint",
                   [](ArrayLiteral& a, const CompletedLoop& l) { a.add_integer(l.fence); }},
    AnalysisColumn{
        "program_version", "text",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).program_version); }},
    AnalysisColumn{
        "settings", "text",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).settings_json); },
        "::jsonb"},
    AnalysisColumn{
        "input_digest", "text",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).input_digest); }},
    AnalysisColumn{
        "fetch_ms", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).fetch_ms); }},
    AnalysisColumn{
        "analyse_ms", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).analyse_ms); }},
    AnalysisColumn{
        "prepare_ms", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).prepare_ms); }},
    AnalysisColumn{
        "statistics_ms", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).statistics_ms); }},
    AnalysisColumn{
        "model_ms", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).model_ms); }},
    AnalysisColumn{
        "window_start", "timestamptz",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).window_start_us); }},
    AnalysisColumn{
        "window_end", "timestamptz",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).window_end_us); }},
    AnalysisColumn{"samples", "bigint",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     a.add_integer(static_cast<std::int64_t>(record(l).samples));
                   }},
    AnalysisColumn{
        "interval_s", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).sample_interval_s); }},
    AnalysisColumn{"usable", "boolean",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     a.add_boolean(evidence(l).data_quality.usable && is_controlled(l));
                   }},
    AnalysisColumn{"unusable_reason", "text",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     const std::string& reason = evidence(l).data_quality.reason;
                     add_optional_text(
                         a, reason.empty() && !is_controlled(l) ? kNotControlled : reason);
                   }},
    AnalysisColumn{"flags", "text",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     a.add_text_list(evidence(l).data_quality.flags);
                   },
                   "::text[]"},
    AnalysisColumn{"control_fraction", "float8",
                   add_figure<&Evidence::control, &ControlState::acting_fraction>},
    AnalysisColumn{"control_lost_by", "text", add_lost_by},
    AnalysisColumn{"control_lost_at", "timestamptz", add_lost_at},
    AnalysisColumn{"op_range_doubt", "text", add_doubt},
    AnalysisColumn{"past_pv_flat_s", "float8", add_past_pv_flat},
    AnalysisColumn{"past_pv_step", "float8", add_past_pv_step},
    AnalysisColumn{"pv_flat_s", "float8",
                   add_figure<&Evidence::pv_past, &core::signal::PvPast::longest_flat_s>},
    AnalysisColumn{"pv_step", "float8", add_pv_step},
    AnalysisColumn{"missing_fraction", "float8", quality<&DataQuality::missing_fraction>},
    AnalysisColumn{"compression_factor", "float8", quality<&DataQuality::compression_factor>},
    AnalysisColumn{"quantisation_factor", "float8", quality<&DataQuality::quantisation_factor>},
    AnalysisColumn{"saturated_fraction", "float8", quality<&DataQuality::saturated_fraction>},
    AnalysisColumn{"segments", "integer", add_hos<&Result::segments>},
    AnalysisColumn{"bifrequencies", "integer", add_hos<&Result::bifrequencies>},
    AnalysisColumn{"mean_bic2", "float8", add_hos<&Result::mean_bic2>},
    AnalysisColumn{"std_bic2", "float8", add_hos<&Result::std_bic2>},
    AnalysisColumn{"max_bic2", "float8", add_hos<&Result::max_bic2>},
    AnalysisColumn{"critical_mean_bic2", "float8", add_hos<&Result::critical_mean_bic2>},
    AnalysisColumn{"ngi", "float8", add_hos<&Result::ngi>},
    AnalysisColumn{"nli", "float8", add_hos<&Result::nli>},
    AnalysisColumn{"published_gaussian", "boolean",
                   add_published<&core::hos::PublishedDecision::gaussian>},
    AnalysisColumn{"published_linear", "boolean",
                   add_published<&core::hos::PublishedDecision::linear>},
    AnalysisColumn{"skewness", "float8", add_hos<&Result::skewness>},
    AnalysisColumn{"excess_kurtosis", "float8", add_hos<&Result::excess_kurtosis>},
    AnalysisColumn{"ngi_p", "float8", add_hos<&Result::ngi_p>},
    AnalysisColumn{"nli_p", "float8", add_hos<&Result::nli_p>},
    AnalysisColumn{"cubic_p", "float8", add_hos<&Result::cubic_p>},
    AnalysisColumn{"nonlinear_p", "float8", add_hos<&Result::nonlinear_p>},
    AnalysisColumn{"innovation_p", "float8", add_hos<&Result::innovation_p>},
    AnalysisColumn{"tested_on", "text", add_tested_on},
    AnalysisColumn{"heavy_tails_p", "float8", add_noise<&core::hos::NoiseShape::tails_p>},
    AnalysisColumn{"variance_changes_p", "float8", add_noise<&core::hos::NoiseShape::variance_p>},
    AnalysisColumn{"coupling", "text", add_coupling},
    AnalysisColumn{"hos_slow", "text",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     add_optional_text(a, record(l).hos_slow_json);
                   },
                   "::jsonb"},
    AnalysisColumn{"oscillating", "boolean",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     a.add_boolean(evidence(l).oscillation.present);
                   }},
    AnalysisColumn{"oscillation_period_s", "float8", oscillation<&Oscillation::period_s>},
    AnalysisColumn{"oscillation_regularity", "float8", oscillation<&Oscillation::regularity>},
    AnalysisColumn{"oscillation_amplitude", "float8", oscillation<&Oscillation::amplitude>},
    AnalysisColumn{"oscillation_persistence", "float8", oscillation<&Oscillation::persistence>},
    AnalysisColumn{"oscillation_p", "float8", oscillation<&Oscillation::p>},
    AnalysisColumn{"harris_low", "float8", performance<&Performance::harris_low>},
    AnalysisColumn{"harris_high", "float8", performance<&Performance::harris_high>},
    AnalysisColumn{"harris_p", "float8", performance<&Performance::harris_p>},
    AnalysisColumn{"error_std", "float8", performance<&Performance::error_std>},
    AnalysisColumn{"error_log_variance_se", "float8",
                   performance<&Performance::error_log_variance_se>},
    AnalysisColumn{"valve_travel_per_h", "float8", performance<&Performance::valve_travel_per_h>},
    AnalysisColumn{"reversals_per_h", "float8", performance<&Performance::reversals_per_h>},
    AnalysisColumn{"auto_fraction", "float8", performance<&Performance::auto_fraction>},
    AnalysisColumn{"at_limit_fraction", "float8", performance<&Performance::at_limit_fraction>},
    AnalysisColumn{"horch_dtau", "float8", shape<&Shape::horch_dtau>},
    AnalysisColumn{"horch_drho", "float8", shape<&Shape::horch_drho>},
    AnalysisColumn{"shape_index", "float8", shape<&Shape::shape_index>},
    AnalysisColumn{"ellipse_stiction", "float8", shape<&Shape::ellipse_stiction>},
    AnalysisColumn{"ellipse_r2", "float8", shape<&Shape::ellipse_r2>},
    AnalysisColumn{"mv_op_width", "float8", shape<&Shape::mv_op_width>},
    AnalysisColumn{"mv_slip_jump", "float8", shape<&Shape::mv_slip_jump>},
    AnalysisColumn{"mv_stuck_fraction", "float8", shape<&Shape::mv_stuck_fraction>},
    AnalysisColumn{"model_excited", "boolean",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     const std::optional<Explanation>& model = evidence(l).model;
                     model ? a.add_boolean(model->excited) : a.add_null();
                   }},
    AnalysisColumn{"model_error_kind", "text",
                   [](ArrayLiteral& a, const CompletedLoop& l) {
                     const std::optional<Explanation>& model = evidence(l).model;
                     model ? a.add_text(name(model->error_kind)) : a.add_null();
                   }},
    AnalysisColumn{"model_noise_floor", "float8",
                   add_model<[](const Explanation& m) { return m.noise_floor; }>},
    AnalysisColumn{"model_baseline_error", "float8",
                   add_model<[](const Explanation& m) { return m.baseline.holdout_error; }>},
    AnalysisColumn{"model_unexplained_fraction", "float8",
                   add_model<[](const Explanation& m) { return m.unexplained.fraction; }>},
    // The steps have rows of their own.
    AnalysisColumn{
        "model", "text",
        [](ArrayLiteral& a, const CompletedLoop& l) { add_optional_text(a, record(l).model_json); },
        "::jsonb - 'steps'::text"},
};

}  // namespace

std::span<const AnalysisColumn> analysis_columns() {
  return kColumns;
}

}  // namespace loopscope::storage
