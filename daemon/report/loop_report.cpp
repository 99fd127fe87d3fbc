#include "daemon/report/loop_report.hpp"

#include <exception>
#include <iterator>
#include <utility>

#include "daemon/report/figures/draw_figures.hpp"
#include "daemon/report/figures/explanation_figures.hpp"
#include "daemon/report/figures/history_figures.hpp"
#include "daemon/report/figures/residual_pairs.hpp"
#include "daemon/report/figures/signal_figures.hpp"
#include "daemon/report/figures/spectrum_figures.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

void append(std::vector<Figure>& to, std::vector<Figure>&& from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

/// Diagnoses again; a window that throws is told of, as the service sets such a loop aside.
void look(LoopReport& story, const storage::CatalogueEntry& loop, const LoopInput& input,
          const core::AnalysisSettings& settings) {
  try {
    story.evidence = rediagnose(loop, input, settings);
  } catch (const std::exception& error) {
    story.trouble = std::string("the window could not be analysed again: ") + error.what();
  }
}

/// All pictures by one run of gnuplot: those of the window and the past, then those of the steps.
void draw(LoopReport& story, const std::filesystem::path& gnuplot, const std::stop_token& stop) {
  std::vector<Figure> figures = figures_of(story);
  const std::size_t shown = figures.size();
  std::vector<std::size_t> steps;
  if (story.evidence) {
    for (ResidualPair& pair : residual_pairs(*story.evidence)) {
      steps.push_back(pair.step);
      figures.push_back(std::move(pair.before));
      figures.push_back(std::move(pair.after));
    }
  }
  std::vector<Picture> pictures = draw_figures(figures, gnuplot, stop);
  for (std::size_t k = 0; k < steps.size(); ++k)
    story.chain.push_back(
        {steps[k], std::move(pictures[shown + 2 * k]), std::move(pictures[shown + 2 * k + 1])});
  pictures.resize(shown);
  story.pictures = std::move(pictures);
}

}  // namespace

LoopReport read_story(storage::ReportDatabase& database, const storage::FlaggedRow& row) {
  LoopReport story;
  story.row = row;
  story.history = database.history(row.loop_id, row.slot_end_us - kHistoryReachUs);
  if (row.rank == 0) story.hidden = database.hidden_by(row.loop_id);  // a flagged one is not
  story.followed = database.followed_by(row.loop_id);
  story.problems = database.data_problems(row.loop_id);
  story.repairs = database.repairs_of(row.loop_id);
  return story;
}

std::vector<Figure> figures_of(const LoopReport& story) {
  std::vector<Figure> figures;
  if (story.evidence) {
    const LoopEvidence& evidence = *story.evidence;
    std::vector<Figure> trends = trend_figures(evidence);
    std::vector<Figure> explained = explanation_figures(evidence);
    // The first row tells the story: a few cycles, the valve, the model beside what was measured.
    if (trends.size() > 1) figures.push_back(std::move(trends[1]));
    append(figures, valve_figures(evidence));
    if (!explained.empty()) figures.push_back(std::move(explained[0]));
    if (!trends.empty()) figures.push_back(std::move(trends[0]));
    append(figures, spectrum_figures(evidence));
    append(figures, bicoherence_figures(evidence));
    for (std::size_t k = 1; k < explained.size(); ++k) figures.push_back(std::move(explained[k]));
  }
  append(figures, history_figures(story.history));
  return figures;
}

void add_figures(LoopReport& story, const storage::CatalogueEntry& loop,
                 const WindowSource::Reading& reading, const core::AnalysisSettings& settings,
                 const std::filesystem::path& gnuplot, const std::stop_token& stop) {
  if (const auto* trouble = std::get_if<std::string>(&reading))
    story.trouble = *trouble;
  else
    look(story, loop, std::get<LoopInput>(reading), settings);
  try {
    draw(story, gnuplot, stop);
  } catch (const Failure& failure) {
    story.trouble = failure.what();
  }
}

}  // namespace loopscope::daemon
