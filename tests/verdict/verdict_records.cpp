/// Figures and truth of labelled records, a row of tab-separated text each: what tests/verdict/train
/// fits curves to.

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "core/diagnosis/figure.hpp"
#include "core/diagnosis/gather_evidence.hpp"
#include "core/diagnosis/loop_model.hpp"
#include "core/diagnosis/step_figures.hpp"
#include "tests/core/model/field_recordings.hpp"
#include "tests/support/command_words.hpp"
#include "tests/support/in_threads.hpp"
#include "tests/verdict/as_recorded.hpp"

namespace loopscope::tests::verdict {
namespace {

using core::diagnosis::VerdictCode;

constexpr const char* kUsage =
    "usage: verdict_records [--seed N] [--records M] [--threads T]\n"
    "       verdict_records --recordings MANIFEST.csv\n"
    "Records N to N + M - 1, or the recordings of a manifest (tests/core/model/field_recordings.hpp)\n"
    "with their names and labels in place of seeds and causes. Columns: seed, family, causes, doubtful ones, then the figures; empty =\n"
    "not computed. A figure that a loop without a model lacks is marked by a star.\n";

struct Plan {
  std::uint64_t seed = 1;
  std::size_t records = 100;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string manifest;  ///< not empty: recordings instead
  bool help = false;
};

Plan plan_of(const std::vector<std::string>& words_given) {
  Plan plan;
  CommandWords words(words_given);
  while (!words.done()) {
    const std::string option = words.next();
    if (option == "--help")
      plan.help = true;
    else if (option == "--seed")
      plan.seed = words.count(option, 0);
    else if (option == "--records")
      plan.records = words.count(option, 1);
    else if (option == "--recordings")
      plan.manifest = words.value(option);
    else if (option == "--threads")
      plan.threads = static_cast<unsigned>(words.count(option, 1));
    else
      throw WrongUsage("no such option, " + option);
  }
  return plan;
}

std::string joined(const std::set<VerdictCode>& codes) {
  std::string text;
  for (const VerdictCode code : codes) {
    if (!text.empty()) text += ",";
    text += name(code);
  }
  return text;
}

bool of_model(const core::diagnosis::Figure& figure) {
  const auto steps = core::diagnosis::step_figures();
  return figure.name.starts_with("model.") ||
         std::ranges::any_of(steps, [&](const core::diagnosis::Figure& step) {
           return step.name == figure.name;
         });
}

std::string heading() {
  std::string text = "seed\tfamily\tcauses\tdoubtful";
  for (const core::diagnosis::Figure& figure : core::diagnosis::all_figures())
    text += "\t" + std::string(figure.name) + (of_model(figure) ? "*" : "");
  return text + "\n";
}

/// Empty where the data cannot be judged. `first_cells`: what stands before the figures.
std::string row_of(const LabelledRecord& record, const std::string& first_cells) {
  const core::AnalysisSettings settings;
  const core::FirstLook first = core::first_look(record.window, settings);
  core::Evidence evidence = core::gather_evidence(first, settings, record.facts);
  if (!evidence.data_quality.usable || !evidence.hos) return {};
  if (core::can_be_modelled(first, evidence)) {
    evidence.model = core::explain_loop(first, record.facts,
                                        evidence.cycle ? &*evidence.cycle : nullptr);
  }
  std::string row = first_cells;
  for (const std::optional<double>& value : core::diagnosis::measure_figures(evidence))
    row += value ? fmt::format("\t{:.9g}", *value) : "\t";
  return row + "\n";
}

std::string simulated_row(std::uint64_t seed) {
  const LabelledRecord record = draw_record(seed);
  return row_of(record, fmt::format("{}\t{}\t{}\t{}", seed, record.truth.family,
                                    joined(record.truth.causes), joined(record.truth.doubtful)));
}

/// One look at the last window, as `loopscope analyze --window` takes it.
std::string recorded_row(const model::FieldRecording& recording) {
  LabelledRecord record;
  record.window.sp = recording.sp;
  record.window.pv = recording.pv;
  record.window.op = recording.op;
  record.facts.integrating = core::is_integrating_type(recording.type);
  return row_of(record, fmt::format("{}\t{}\t{}\t", recording.name, recording.type,
                                    recording.label));
}

void print_recordings(const std::string& manifest) {
  for (const model::FieldRecording& recording : model::recordings_of(manifest))
    std::cout << recorded_row(recording);
}

void run(const std::vector<std::string>& words) {
  const Plan plan = plan_of(words);
  if (plan.help) {
    std::cout << kUsage;
    return;
  }
  std::cout << heading();
  if (!plan.manifest.empty()) {
    print_recordings(plan.manifest);
    return;
  }
  constexpr std::size_t kTogether = 64;
  for (std::size_t done = 0; done < plan.records; done += kTogether) {
    std::vector<std::string> rows(std::min(kTogether, plan.records - done));
    in_threads(rows.size(), plan.threads,
               [&](std::size_t k) { rows[k] = simulated_row(plan.seed + done + k); });
    for (const std::string& row : rows) std::cout << row;
    std::cout.flush();
  }
}

}  // namespace
}  // namespace loopscope::tests::verdict

int main(int argc, char** argv) {
  return loopscope::tests::run_program(argc, argv, loopscope::tests::verdict::run);
}
