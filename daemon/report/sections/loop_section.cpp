#include "daemon/report/sections/loop_section.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "core/diagnosis/model_words.hpp"
#include "core/diagnosis/plain_evidence.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/sections/cause_bars.hpp"
#include "daemon/report/sections/data_section.hpp"
#include "daemon/report/sections/follow_words.hpp"
#include "daemon/report/sections/picture_rows.hpp"
#include "daemon/report/sections/repairs_table.hpp"
#include "daemon/report/sections/why_not_listed.hpp"
#include "daemon/report/text/page_text.hpp"
#include "daemon/report/text/pv_unit.hpp"
#include "daemon/text/time_text.hpp"

namespace loopscope::daemon {
namespace {

using core::model::Explanation;
using core::model::Step;
using storage::FlaggedRow;

std::string score_words(const FlaggedRow& row) {
  if (row.rank == 0) return {};
  return fmt::format(
      ", priority {} = severity {} \u00d7 importance {} \u00d7 kind {} \u00d7 confidence {}",
      digits(row.score), two_decimals(row.severity), digits(row.importance),
      two_decimals(row.kind_weight), two_decimals(row.believed()));
}

/// Of a first window, and where all say the same, once is enough.
std::string believed_otherwise(const FlaggedRow& row) {
  const std::string believed = two_decimals(row.believed());
  return believed == two_decimals(row.confidence) ? "" : believed;
}

Fields heading(const LoopReport& loop_report) {
  const FlaggedRow& row = loop_report.row;
  const bool listed = row.rank > 0;
  return {{"id", row.loop_id},
          {"rank", listed ? std::to_string(row.rank) : ""},
          {"name", row.loop_name},
          {"type", row.loop_type ? *row.loop_type + " loop" : "loop"},
          {"pv_unit", row.pv_unit},
          {"source", row.source},
          {"score", score_words(row)},
          {"code", shown_code(loop_report)},
          {"verdict", as_heading(shown_code(loop_report))},
          {"confidence", two_decimals(row.confidence)},
          {"believed", believed_otherwise(row)},
          {"any_fault", row.fault_probability ? two_decimals(*row.fault_probability) : ""},
          {"status_class", listed ? row.status : ""},
          {"status", listed ? status_words(row.status) : "not flagged"},
          {"since",
           minute_in_zone(row.since_us, loop_report.zone) + (row.or_earlier ? " or earlier" : "")},
          {"until", minute_in_zone(row.slot_end_us, loop_report.zone)}};
}

/// What a loop follows: instead of its verdict where it is only shaken, else besides.
Fields following(const LoopReport& loop_report) {
  const bool shaken = is_only_shaken(loop_report);
  const auto& followed = loop_report.followed;
  return {{"shaken", shaken},
          {"shaken_by", shaken ? followed->source_name.value_or("") : ""},
          {"own_verdict", in_words(loop_report.row.code)},
          {"follows", followed ? follow_sentence(*followed) : Markup()},
          {"follows_too", followed && !shaken}};
}

/// Of the window as the historian gives it now.
Markup causes_of(const LoopReport& loop_report) {
  return loop_report.evidence ? cause_bars(loop_report.evidence->diagnosis.verdict) : Markup();
}

Fields findings(const LoopReport& loop_report) {
  return {{"summary", loop_report.row.summary},
          {"source_of", number_text(loop_report.row.plant_oscillation_number)},
          {"hidden",
           why_not_listed(loop_report.hidden, loop_report.zone, loop_report.annotate_address)},
          {"annotate", loop_report.annotate_address},
          {"action", loop_report.row.action},
          {"causes", causes_of(loop_report)}};
}

/// Plain sentences first, figures behind a fold; rows of a program before have figures alone.
Fields reasons(const FlaggedRow& row) {
  const auto mark = std::ranges::find(row.reasons, core::diagnosis::kFiguresFollow);
  const bool folded = mark != row.reasons.end();
  const auto plain_end = folded ? mark : row.reasons.begin();
  using Texts = std::vector<std::string>;
  const auto in_unit = [&](auto from, auto to) {
    Texts texts;
    for (; from != to; ++from) texts.push_back(in_pv_unit(*from, row.pv_unit));
    return texts;
  };
  return {{"plain_reasons", in_unit(row.reasons.begin(), plain_end)},
          {"folded", folded},
          {"figures", in_unit(folded ? mark + 1 : plain_end, row.reasons.end())},
          {"p", row.p ? p_text(row.p) : ""}};
}

/// The verdict that the pictures show may be another than the stored one: late rows, settings.
std::string judged_now(const LoopReport& loop_report) {
  if (!loop_report.evidence) return {};
  const std::string now(core::diagnosis::name(loop_report.evidence->diagnosis.verdict.code));
  return now == loop_report.row.code ? "" : in_words(now);
}

const std::optional<Explanation>& model_of(const LoopReport& loop_report) {
  static const std::optional<Explanation> none;
  return loop_report.evidence ? loop_report.evidence->diagnosis.evidence.model : none;
}

Fields parts(const LoopReport& loop_report) {
  const std::optional<Explanation>& model = model_of(loop_report);
  return {
      {"judged_now", judged_now(loop_report)},
      {"trouble", loop_report.trouble},
      {"any_picture", !loop_report.pictures.empty()},
      {"pictures", picture_rows(loop_report.pictures)},
      {"chain", model ? chain_table(*model, loop_report.chain) : Markup()},
      {"explanation", model ? explanation_table(*model, loop_report.row.pv_unit) : Markup()},
      {"repairs", repairs_table(loop_report.repairs, loop_report.zone, loop_report.row.pv_unit)},
      {"data", data_section(loop_report)}};
}

Fields stage(const std::string& words, const std::string& figures, const std::string& before,
             const std::string& after, const std::string& evidence, const std::string& p) {
  return {{"stage", words}, {"figures", figures},   {"before", before},
          {"after", after}, {"evidence", evidence}, {"p", p}};
}

List stages(const Explanation& explanation, const std::string& pv_unit) {
  List all = {stage("Linear model", in_pv_unit(explanation.baseline.description, pv_unit), kUnknown,
                    digits(explanation.baseline.holdout_error), kUnknown, kUnknown)};
  for (const Step& step : explanation.steps)
    all.push_back(stage("+ " + in_words(name(step.effect)), parameters_text(step),
                        digits(step.holdout_error_before), digits(step.holdout_error_after),
                        digits(step.evidence), p_text(step.p)));
  all.push_back(stage("Noise floor", "what a perfect model would leave", kUnknown,
                      digits(explanation.noise_floor), kUnknown, kUnknown));
  return all;
}

std::vector<std::string> rest_texts(const Explanation& explanation, const std::string& pv_unit) {
  std::vector<std::string> texts = {
      core::diagnosis::effects_text(explanation), core::diagnosis::floor_text(explanation),
      in_pv_unit(core::diagnosis::unexplained_text(explanation), pv_unit)};
  std::erase(texts, std::string());
  if (explanation.closed_loop)
    texts.push_back(core::diagnosis::closed_loop_text(*explanation.closed_loop));
  if (!explanation.process_doubt.empty()) texts.push_back(explanation.process_doubt);
  return texts;
}

}  // namespace

Markup explanation_table(const Explanation& explanation, const std::string& pv_unit) {
  return render("explanation_table", {{"excited", explanation.excited},
                                      {"excitation", explanation.excitation},
                                      {"error_kind", in_words(name(explanation.error_kind))},
                                      {"squares", in_pv_unit("pv units", pv_unit)},
                                      {"stages", stages(explanation, pv_unit)},
                                      {"rest", rest_texts(explanation, pv_unit)}});
}

Markup loop_section(const LoopReport& loop_report, const Markup& trend) {
  Fields fields = {{"trend", trend}};
  for (Fields& part :
       std::array{heading(loop_report), following(loop_report), findings(loop_report),
                  reasons(loop_report.row), parts(loop_report)})
    std::ranges::move(part, std::back_inserter(fields));
  return render("loop_section", std::move(fields));
}

}  // namespace loopscope::daemon
