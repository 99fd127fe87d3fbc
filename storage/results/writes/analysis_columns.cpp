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

/// One column of loopscope.analysis: its name, the type of the array that carries it, the cast
/// that it needs besides (text[] and jsonb travel as text), and what it holds.
struct Column {
  std::string_view name;
  std::string_view type;
  void (*add)(ArrayLiteral&, const CompletedLoop&);
  std::string_view cast{};
};

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
    Column{"loop_id", "bigint",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_integer(l.loop_id); }},
    Column{"slot_end", "timestamptz",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).slot_end_us); }},
    Column{"algorithm_revision", "integer",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             a.add_integer(record(l).algorithm_revision);
           }},
    Column{"fence", "bigint",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_integer(l.fence); }},
    Column{"program_version", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).program_version); }},
    Column{"settings", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).settings_json); },
           "::jsonb"},
    Column{"input_digest", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_text(record(l).input_digest); }},
    Column{"fetch_ms", "float8",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).fetch_ms); }},
    Column{"analyse_ms", "float8",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).analyse_ms); }},
    Column{"prepare_ms", "float8",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).prepare_ms); }},
    Column{"statistics_ms", "float8",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).statistics_ms); }},
    Column{"model_ms", "float8",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).model_ms); }},
    Column{"window_start", "timestamptz",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).window_start_us); }},
    Column{"window_end", "timestamptz",
           [](ArrayLiteral& a, const CompletedLoop& l) { a.add_time(record(l).window_end_us); }},
    Column{"samples", "bigint",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             a.add_integer(static_cast<std::int64_t>(record(l).samples));
           }},
    Column{
        "interval_s", "float8",
        [](ArrayLiteral& a, const CompletedLoop& l) { a.add_number(record(l).sample_interval_s); }},
    Column{"usable", "boolean",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             a.add_boolean(evidence(l).data_quality.usable && is_controlled(l));
           }},
    Column{"unusable_reason", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             const std::string& reason = evidence(l).data_quality.reason;
             add_optional_text(a, reason.empty() && !is_controlled(l) ? kNotControlled : reason);
           }},
    Column{"flags", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             a.add_text_list(evidence(l).data_quality.flags);
           },
           "::text[]"},
    Column{"control_fraction", "float8",
           add_figure<&Evidence::control, &ControlState::acting_fraction>},
    Column{"control_lost_by", "text", add_lost_by},
    Column{"control_lost_at", "timestamptz", add_lost_at},
    Column{"op_range_doubt", "text", add_doubt},
    Column{"past_pv_flat_s", "float8", add_past_pv_flat},
    Column{"past_pv_step", "float8", add_past_pv_step},
    Column{"pv_flat_s", "float8",
           add_figure<&Evidence::pv_past, &core::signal::PvPast::longest_flat_s>},
    Column{"pv_step", "float8", add_pv_step},
    Column{"missing_fraction", "float8", quality<&DataQuality::missing_fraction>},
    Column{"compression_factor", "float8", quality<&DataQuality::compression_factor>},
    Column{"quantisation_factor", "float8", quality<&DataQuality::quantisation_factor>},
    Column{"saturated_fraction", "float8", quality<&DataQuality::saturated_fraction>},
    Column{"segments", "integer", add_hos<&Result::segments>},
    Column{"bifrequencies", "integer", add_hos<&Result::bifrequencies>},
    Column{"mean_bic2", "float8", add_hos<&Result::mean_bic2>},
    Column{"std_bic2", "float8", add_hos<&Result::std_bic2>},
    Column{"max_bic2", "float8", add_hos<&Result::max_bic2>},
    Column{"critical_mean_bic2", "float8", add_hos<&Result::critical_mean_bic2>},
    Column{"ngi", "float8", add_hos<&Result::ngi>},
    Column{"nli", "float8", add_hos<&Result::nli>},
    Column{"published_gaussian", "boolean", add_published<&core::hos::PublishedDecision::gaussian>},
    Column{"published_linear", "boolean", add_published<&core::hos::PublishedDecision::linear>},
    Column{"skewness", "float8", add_hos<&Result::skewness>},
    Column{"excess_kurtosis", "float8", add_hos<&Result::excess_kurtosis>},
    Column{"ngi_p", "float8", add_hos<&Result::ngi_p>},
    Column{"nli_p", "float8", add_hos<&Result::nli_p>},
    Column{"cubic_p", "float8", add_hos<&Result::cubic_p>},
    Column{"nonlinear_p", "float8", add_hos<&Result::nonlinear_p>},
    Column{"innovation_p", "float8", add_hos<&Result::innovation_p>},
    Column{"tested_on", "text", add_tested_on},
    Column{"heavy_tails_p", "float8", add_noise<&core::hos::NoiseShape::tails_p>},
    Column{"variance_changes_p", "float8", add_noise<&core::hos::NoiseShape::variance_p>},
    Column{"coupling", "text", add_coupling},
    Column{"hos_slow", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             add_optional_text(a, record(l).hos_slow_json);
           },
           "::jsonb"},
    Column{"oscillating", "boolean",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             a.add_boolean(evidence(l).oscillation.present);
           }},
    Column{"oscillation_period_s", "float8", oscillation<&Oscillation::period_s>},
    Column{"oscillation_regularity", "float8", oscillation<&Oscillation::regularity>},
    Column{"oscillation_amplitude", "float8", oscillation<&Oscillation::amplitude>},
    Column{"oscillation_persistence", "float8", oscillation<&Oscillation::persistence>},
    Column{"oscillation_p", "float8", oscillation<&Oscillation::p>},
    Column{"harris_low", "float8", performance<&Performance::harris_low>},
    Column{"harris_high", "float8", performance<&Performance::harris_high>},
    Column{"harris_p", "float8", performance<&Performance::harris_p>},
    Column{"error_std", "float8", performance<&Performance::error_std>},
    Column{"error_log_variance_se", "float8", performance<&Performance::error_log_variance_se>},
    Column{"valve_travel_per_h", "float8", performance<&Performance::valve_travel_per_h>},
    Column{"reversals_per_h", "float8", performance<&Performance::reversals_per_h>},
    Column{"auto_fraction", "float8", performance<&Performance::auto_fraction>},
    Column{"at_limit_fraction", "float8", performance<&Performance::at_limit_fraction>},
    Column{"horch_dtau", "float8", shape<&Shape::horch_dtau>},
    Column{"horch_drho", "float8", shape<&Shape::horch_drho>},
    Column{"shape_index", "float8", shape<&Shape::shape_index>},
    Column{"ellipse_stiction", "float8", shape<&Shape::ellipse_stiction>},
    Column{"ellipse_r2", "float8", shape<&Shape::ellipse_r2>},
    Column{"mv_op_width", "float8", shape<&Shape::mv_op_width>},
    Column{"mv_slip_jump", "float8", shape<&Shape::mv_slip_jump>},
    Column{"mv_stuck_fraction", "float8", shape<&Shape::mv_stuck_fraction>},
    Column{"model_excited", "boolean",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             const std::optional<Explanation>& model = evidence(l).model;
             model ? a.add_boolean(model->excited) : a.add_null();
           }},
    Column{"model_error_kind", "text",
           [](ArrayLiteral& a, const CompletedLoop& l) {
             const std::optional<Explanation>& model = evidence(l).model;
             model ? a.add_text(name(model->error_kind)) : a.add_null();
           }},
    Column{"model_noise_floor", "float8",
           add_model<[](const Explanation& m) { return m.noise_floor; }>},
    Column{"model_baseline_error", "float8",
           add_model<[](const Explanation& m) { return m.baseline.holdout_error; }>},
    Column{"model_unexplained_fraction", "float8",
           add_model<[](const Explanation& m) { return m.unexplained.fraction; }>},
    // The steps have rows of their own.
    Column{
        "model", "text",
        [](ArrayLiteral& a, const CompletedLoop& l) { add_optional_text(a, record(l).model_json); },
        "::jsonb - 'steps'::text"},
};

/// The worker may not change these.
bool is_key(std::string_view column) {
  return column == "loop_id" || column == "slot_end" || column == "algorithm_revision";
}

/// Who made the row, from what, and in what time; and what it tells the next window, which rows of
/// before schema 106 do not say.
bool is_provenance(std::string_view column) {
  return column == "fence" || column == "program_version" || column == "settings" ||
         column == "input_digest" || column.ends_with("_ms") || column == "pv_flat_s" ||
         column == "pv_step";
}

std::string joined(auto text_of) {
  std::string list;
  for (const Column& column : kColumns) {
    const std::string text = text_of(column);
    if (!text.empty()) list += (list.empty() ? "" : ", ") + text;
  }
  return list;
}

std::string names() {
  return joined([](const Column& column) { return std::string(column.name); });
}

/// The rows that the parameters carry, as they are stored.
std::string select_sql() {
  int parameter = 0;
  const std::string arrays = joined([&](const Column& column) {
    return "$" + std::to_string(++parameter) + "::" + std::string(column.type) + "[]";
  });
  const std::string selected = joined([](const Column& column) {
    return std::string(column.name) + std::string(column.cast) + " AS " + std::string(column.name);
  });
  return "SELECT " + selected + " FROM unnest(" + arrays + ") AS row (" + names() + ")";
}

std::string upsert_sql() {
  const std::string updates = joined([](const Column& column) {
    const std::string name(column.name);
    return is_key(name) ? std::string() : name + " = EXCLUDED." + name;
  });
  return "INSERT INTO loopscope.analysis AS stored (" + names() + ") " + select_sql() +
         " ON CONFLICT (loop_id, slot_end, algorithm_revision) DO UPDATE SET " + updates +
         ", input_revision = stored.input_revision + 1, analysed_at = now()"
         // The fence keeps a late worker from putting older findings over newer ones.
         " WHERE stored.input_digest <> EXCLUDED.input_digest AND stored.fence <= EXCLUDED.fence"
         " RETURNING loop_id, (extract(epoch FROM slot_end) * 1000000)::bigint AS slot_end_us,"
         " input_revision, analysis_id";
}

}  // namespace

const Statement& upsert_analyses() {
  static const Statement statement{"upsert_analyses", upsert_sql()};
  return statement;
}

std::string measured_object(const std::string& row) {
  return "to_jsonb(" + row +
         ") - "
         "'{analysis_id,input_revision,analysed_at,combined_probabilities,combined_evidence,"
         "combined_windows," +
         joined([](const Column& column) {
           return is_key(column.name) || is_provenance(column.name) ? std::string(column.name)
                                                                    : std::string();
         }) +
         "}'::text[]";
}

const Statement& measure_analyses() {
  static const Statement statement{
      "measure_analyses",
      "SELECT " + measured_object("measured") + " FROM (" + select_sql() + ") AS measured"};
  return statement;
}

std::vector<std::string> analysis_parameters(const std::vector<const CompletedLoop*>& loops) {
  std::vector<std::string> parameters;
  parameters.reserve(kColumns.size());
  for (const Column& column : kColumns) {
    ArrayLiteral array;
    for (const CompletedLoop* loop : loops) column.add(array, *loop);
    parameters.push_back(array.text());
  }
  return parameters;
}

}  // namespace loopscope::storage
