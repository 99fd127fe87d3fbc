#include "daemon/report/sections/loop_section.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <span>

#include "core/diagnosis/plain_evidence.hpp"
#include "core/diagnosis/reasons.hpp"
#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/results/phrases.hpp"
#include "daemon/report/figures/compact_svg.hpp"
#include "daemon/report/sections/cause_bars.hpp"
#include "daemon/report/sections/data_section.hpp"
#include "daemon/report/sections/follow_words.hpp"
#include "daemon/report/sections/hidden_words.hpp"
#include "daemon/report/sections/repairs_table.hpp"
#include "daemon/report/text/html_text.hpp"
#include "daemon/report/text/page_text.hpp"

namespace loopscope::daemon {
namespace {

using core::model::Explanation;
using core::model::Step;
using storage::FlaggedRow;

std::string facts_line(const FlaggedRow& row) {
  std::string text = row.loop_type ? html(*row.loop_type) + " loop" : "loop";
  text += ", source <bdi>" + html(row.source) + "</bdi>";
  if (row.rank > 0)
    text += fmt::format(
        ", score {} = severity {} \u00d7 importance {} \u00d7 kind {} \u00d7 confidence {}",
        digits(row.score), two_decimals(row.severity), digits(row.importance),
        two_decimals(row.kind_weight), two_decimals(row.believed()));
  return text;
}

/// By the newest window, by all of them, and whether anything is wrong at all.
std::string confidence_words(const FlaggedRow& row) {
  std::string text =
      fmt::format("<span>confidence <b>{}</b></span> ", two_decimals(row.confidence));
  // Of a first window, and where all say the same, once is enough.
  if (two_decimals(row.believed()) != two_decimals(row.confidence))
    text += fmt::format("<span>with the windows before it <b>{}</b></span> ",
                        two_decimals(row.believed()));
  if (row.fault_probability)
    text += fmt::format("<span>any fault <b>{}</b></span> ", two_decimals(*row.fault_probability));
  return text;
}

std::string heading(const LoopReport& story) {
  const FlaggedRow& row = story.row;
  const std::string code = shown_code(story);
  const std::string rank =
      row.rank > 0 ? fmt::format("<span class=\"rank\">{}</span> ", row.rank) : "";
  const std::string status = row.rank > 0 ? row.status : "not flagged";
  return fmt::format(
      "<h2>{}<bdi>{}</bdi></h2>\n<p class=\"facts\">{}</p>\n<p class=\"finding\">"
      "<span class=\"verdict {}\">{}</span> {}"
      "<span class=\"status {}\">{}</span> <span>since {}</span> <span>window until "
      "{}</span></p>\n",
      rank, html(row.loop_name), facts_line(row), html(code), html(as_heading(code)),
      is_only_shaken(story) ? "" : confidence_words(row), html(row.rank > 0 ? row.status : ""),
      html(status), utc(row.since_us), utc(row.slot_end_us));
}

std::string list_items(std::span<const std::string> reasons) {
  std::string text;
  for (const std::string& reason : reasons) text += "<li>" + html(reason) + "</li>\n";
  return text;
}

/// Plain sentences first, figures behind a fold; rows of a program before have figures alone.
std::string evidence_list(const FlaggedRow& row) {
  const std::span<const std::string> reasons = row.reasons;
  const auto mark = std::ranges::find(reasons, core::diagnosis::kFiguresFollow);
  const bool folded = mark != reasons.end();
  const auto plain = folded ? static_cast<std::size_t>(mark - reasons.begin()) : 0;
  std::string figures = list_items(reasons.subspan(folded ? plain + 1 : 0));
  if (row.p)
    figures += "<li>Chance of evidence as strong as this in a loop without that fault: p " +
               html(p_text(row.p)) + ".</li>\n";
  if (!folded) return "<ul>\n" + figures + "</ul>";
  return "<ul>\n" + list_items(reasons.first(plain)) +
         "</ul>\n<details class=\"figures\"><summary>Figures</summary><ul>\n" + figures +
         "</ul></details>";
}

std::string source_words(const FlaggedRow& row) {
  if (!row.plant_oscillation_number) return {};
  return fmt::format(
      "<dt>Source</dt><dd>The source of plant-wide oscillation {}: repair this loop first, its "
      "victims follow.</dd>\n",
      *row.plant_oscillation_number);
}

/// Of the window as the historian gives it now.
std::string causes_of(const LoopReport& story) {
  return story.evidence ? cause_bars(story.evidence->diagnosis.verdict) : std::string();
}

std::string findings(const LoopReport& story) {
  const FlaggedRow& row = story.row;
  const bool shaken = is_only_shaken(story);
  return fmt::format(
      "<dl class=\"findings\">\n<dt>Cause</dt><dd>{}</dd>\n{}{}{}<dt>Action</dt><dd "
      "class=\"action\">{}</dd>\n{}<dt>Evidence</dt><dd>{}</dd>\n</dl>\n",
      shaken ? shaken_cause(story) : html(row.summary), source_words(row), follow_entry(story),
      hidden_words(story.hidden), shaken ? shaken_action(story) : html(row.action),
      causes_of(story), evidence_list(row));
}

/// The verdict that the pictures show may be another than the stored one: late rows, settings.
std::string difference(const LoopReport& story) {
  if (!story.evidence) return {};
  const std::string now(core::diagnosis::name(story.evidence->diagnosis.verdict.code));
  if (now == story.row.code) return {};
  return fmt::format(
      "<p class=\"trouble\">The pictures show the window as the historian gives it now, which "
      "would "
      "be judged \u201c{}\u201d: its rows or the settings have changed since the verdict was "
      "given.</p>\n",
      html(in_words(now)));
}

std::string pictures(const LoopReport& story) {
  std::string text;
  if (!story.trouble.empty())
    text = "<p class=\"trouble\">No pictures of the window: " + html(story.trouble) + "</p>\n";
  if (story.pictures.empty()) return text;
  text += "<div class=\"pictures\">\n";
  for (const Picture& shown : story.pictures) text += picture_html(shown);
  return text + "</div>\n";
}

std::string table_row(const std::string& stage, const std::string& figures,
                      const std::string& before, const std::string& after,
                      const std::string& evidence, const std::string& p) {
  return fmt::format(
      "<tr><td data-label=\"Stage\">{}</td><td data-label=\"Figures\">{}</td>"
      "<td class=\"number\" data-label=\"Error before\">{}</td>"
      "<td class=\"number\" data-label=\"Error after\">{}</td>"
      "<td class=\"number\" data-label=\"Evidence\">{}</td>"
      "<td class=\"number\" data-label=\"p\">{}</td></tr>\n",
      html(stage), html(figures), before, after, evidence, html(p));
}

std::string rest_text(const Explanation& explanation) {
  std::string text = "<p>" + html(core::diagnosis::unexplained_text(explanation)) + "</p>\n";
  if (explanation.closed_loop)
    text += "<p>" + html(core::diagnosis::closed_loop_text(*explanation.closed_loop)) + "</p>\n";
  if (!explanation.process_doubt.empty())
    text += "<p>" + html(explanation.process_doubt) + "</p>\n";
  return text;
}

std::string explanation_part(const LoopReport& story) {
  if (!story.evidence || !story.evidence->diagnosis.evidence.model) return {};
  const Explanation& explanation = *story.evidence->diagnosis.evidence.model;
  return "<h3>Explanation</h3>\n" + chain_table(explanation, story.chain) +
         explanation_table(explanation);
}

std::string repairs_part(const LoopReport& story) {
  if (story.repairs.empty()) return {};
  return "<h3>Repairs, before and after</h3>\n" + repairs_table(story.repairs);
}

}  // namespace

std::string explanation_table(const Explanation& explanation) {
  if (!explanation.excited)
    return "<p>The process could not be identified: " + html(explanation.excitation) + "</p>\n";
  std::string text = fmt::format(
      "<p class=\"note\">Errors are mean squares in pv units squared, {}, on samples that the fit "
      "has not seen; evidence is n ln(before / after).</p>\n<table class=\"errors\"><thead><tr>"
      "<th>Stage</th><th>Figures (90 % interval)</th><th class=\"number\">Error before</th>"
      "<th class=\"number\">Error after</th><th class=\"number\">Evidence</th>"
      "<th class=\"number\">p</th></tr></thead><tbody>\n",
      html(in_words(name(explanation.error_kind))));
  text += table_row("Linear model", explanation.baseline.description, "\u2013",
                    digits(explanation.baseline.holdout_error), "\u2013", "\u2013");
  for (const Step& step : explanation.steps)
    text += table_row("+ " + in_words(name(step.effect)), parameters_text(step),
                      digits(step.holdout_error_before), digits(step.holdout_error_after),
                      digits(step.evidence), p_text(step.p));
  text += table_row("Noise floor", "what a perfect model would leave", "\u2013",
                    digits(explanation.noise_floor), "\u2013", "\u2013");
  return text + "</tbody></table>\n" + rest_text(explanation);
}

std::string loop_section(const LoopReport& story) {
  return fmt::format("<section class=\"loop\" id=\"loop-{}\">\n", story.row.loop_id) +
         heading(story) + "<div class=\"story\">\n<div class=\"words\">\n" + findings(story) +
         difference(story) + "</div>\n" + pictures(story) + "</div>\n" + explanation_part(story) +
         repairs_part(story) + data_section(story) + "</section>\n";
}

}  // namespace loopscope::daemon
