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
void look(LoopReport& loop_report, const storage::CatalogueEntry& loop, const LoopInput& input,
          const core::AnalysisSettings& settings) {
  try {
    loop_report.evidence = rediagnose(loop, input, settings);
  } catch (const std::exception& error) {
    loop_report.trouble = std::string("the window could not be analysed again: ") + error.what();
  }
}

/// All pictures by one run of gnuplot: those of the window and the past, then those of the steps.
void draw(LoopReport& loop_report, const std::filesystem::path& gnuplot,
          const std::stop_token& stop) {
  std::vector<Figure> figures = figures_of(loop_report);
  const std::size_t shown = figures.size();
  std::vector<std::size_t> steps;
  if (loop_report.evidence) {
    for (ResidualPair& pair : residual_pairs(*loop_report.evidence, loop_report.zone)) {
      steps.push_back(pair.step);
      figures.push_back(std::move(pair.before));
      figures.push_back(std::move(pair.after));
    }
  }
  std::vector<Picture> pictures = draw_figures(figures, gnuplot, stop);
  for (std::size_t k = 0; k < steps.size(); ++k)
    loop_report.chain.push_back(
        {steps[k], std::move(pictures[shown + 2 * k]), std::move(pictures[shown + 2 * k + 1])});
  pictures.resize(shown);
  loop_report.pictures = std::move(pictures);
}

}  // namespace

LoopReport read_loop_report(storage::ReportDatabase& database, const storage::FlaggedRow& row,
                            const TimeZone& zone) {
  LoopReport loop_report;
  loop_report.zone = zone;
  loop_report.row = row;
  loop_report.history = database.history(row.loop_id, row.slot_end_us - kHistoryReachUs);
  loop_report.followed = database.followed_by(row.loop_id);
  loop_report.problems = database.data_problems(row.loop_id);
  loop_report.repairs = database.repairs_of(row.loop_id);
  return loop_report;
}

std::vector<Figure> figures_of(const LoopReport& loop_report) {
  std::vector<Figure> figures;
  if (loop_report.evidence) {
    const LoopEvidence& evidence = *loop_report.evidence;
    std::vector<Figure> trends = trend_figures(evidence, loop_report.zone);
    std::vector<Figure> explained = explanation_figures(evidence, loop_report.zone);
    // The first row shows what matters: a few cycles, the valve, the model beside what was
    // measured.
    if (trends.size() > 1) figures.push_back(std::move(trends[1]));
    append(figures, valve_figures(evidence));
    if (!explained.empty()) figures.push_back(std::move(explained[0]));
    if (!trends.empty()) figures.push_back(std::move(trends[0]));
    append(figures, spectrum_figures(evidence));
    append(figures, bicoherence_figures(evidence));
    for (std::size_t k = 1; k < explained.size(); ++k) figures.push_back(std::move(explained[k]));
  }
  append(figures, history_figures(loop_report.history, loop_report.zone));
  return figures;
}

void add_figures(LoopReport& loop_report, const storage::CatalogueEntry& loop,
                 const WindowSource::Reading& reading, const core::AnalysisSettings& settings,
                 const std::filesystem::path& gnuplot, const std::stop_token& stop) {
  if (const auto* trouble = std::get_if<std::string>(&reading))
    loop_report.trouble = *trouble;
  else
    look(loop_report, loop, std::get<LoopInput>(reading), settings);
  try {
    draw(loop_report, gnuplot, stop);
  } catch (const Failure& failure) {
    loop_report.trouble = failure.what();
  }
}

}  // namespace loopscope::daemon
