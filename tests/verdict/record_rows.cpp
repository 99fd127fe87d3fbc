#include "tests/verdict/record_rows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>

#include "core/diagnosis/diagnose.hpp"
#include "core/diagnosis/evidence/figure.hpp"
#include "core/diagnosis/evidence/step_figures.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "tests/verdict/as_recorded.hpp"

namespace loopscope::tests::verdict {
namespace {

using core::diagnosis::VerdictCode;

std::string joined(const std::set<VerdictCode>& codes) {
  std::string text;
  for (const VerdictCode code : codes) {
    if (!text.empty()) text += ",";
    text += name(code);
  }
  return text;
}

std::string truth_cells(const std::string& name, const Truth& truth) {
  return fmt::format("{}\t{}\t{}\t{}", name, truth.family, joined(truth.causes),
                     joined(truth.doubtful));
}

bool of_model(const core::diagnosis::Figure& figure) {
  const auto steps = core::diagnosis::step_figures();
  return figure.name.starts_with("model.") ||
         std::ranges::any_of(
             steps, [&](const core::diagnosis::Figure& step) { return step.name == figure.name; });
}

/// Empty where the data cannot be judged. `first_cells`: what stands before the figures.
std::string row_of(const LabelledRecord& record, const std::string& first_cells) {
  const core::AnalysisSettings settings;
  const core::FirstLook first = core::first_look(record.window, settings);
  core::Evidence evidence = core::gather_evidence(first, settings, record.facts);
  if (!evidence.data_quality.usable || !evidence.hos) return {};
  if (core::can_be_modelled(first, evidence)) {
    evidence.model =
        core::explain_loop(first, record.facts, evidence.cycle ? &*evidence.cycle : nullptr);
  }
  std::string row = first_cells;
  for (const std::optional<double>& value : core::diagnosis::measure_figures(evidence))
    row += value ? fmt::format("\t{:.9g}", *value) : "\t";
  return row + "\n";
}

}  // namespace

std::string heading() {
  std::string text = "seed\tfamily\tcauses\tdoubtful";
  for (const core::diagnosis::Figure& figure : core::diagnosis::all_figures())
    text += "\t" + std::string(figure.name) + (of_model(figure) ? "*" : "");
  return text + "\n";
}

std::string simulated_row(std::uint64_t seed) {
  const LabelledRecord record = draw_record(seed);
  return row_of(record, truth_cells(std::to_string(seed), record.truth));
}

std::string window_rows(std::uint64_t seed, std::size_t windows) {
  std::string rows;
  std::size_t number = 0;
  for (const SuccessiveWindow& window : draw_windows(seed, windows)) {
    const std::string name = fmt::format("{}/{}/{:.6g}", seed, ++number, window.new_share);
    rows += row_of(window.record, truth_cells(name, window.record.truth));
  }
  return rows;
}

std::string recorded_row(const model::FieldRecording& recording) {
  LabelledRecord record;
  record.window.sp = recording.sp;
  record.window.pv = recording.pv;
  record.window.op = recording.op;
  record.facts.integrating = core::is_integrating_type(recording.type);
  return row_of(record,
                fmt::format("{}\t{}\t{}\t", recording.name, recording.type, recording.label));
}

}  // namespace loopscope::tests::verdict
