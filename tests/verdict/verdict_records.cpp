/// Figures and truth of labelled records, a row of tab-separated text each: what
/// tests/verdict/train fits curves to.

#include <algorithm>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/command_words.hpp"
#include "tests/support/in_threads.hpp"
#include "tests/verdict/record_rows.hpp"

namespace loopscope::tests::verdict {
namespace {

constexpr const char* kUsage =
    "usage: verdict_records [--seed N] [--records M] [--windows W] [--threads T]\n"
    "       verdict_records --recordings MANIFEST.csv\n"
    "Records N to N + M - 1, or the recordings of a manifest "
    "(tests/core/model/field_recordings.hpp)\n"
    "with their names and labels in place of seeds and causes. Columns: seed, family, causes, "
    "doubtful ones, then the figures; empty =\n"
    "not computed. With --windows each record is looked at W times, by successive windows, and\n"
    "the first cell is seed/window/share of new samples. A figure that a loop without a model "
    "lacks is marked by a star.\n";

struct Plan {
  std::uint64_t seed = 1;
  std::size_t records = 100;
  std::size_t windows = 1;
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
    else if (option == "--windows")
      plan.windows = words.count(option, 1);
    else if (option == "--recordings")
      plan.manifest = words.value(option);
    else if (option == "--threads")
      plan.threads = static_cast<unsigned>(words.count(option, 1));
    else
      throw WrongUsage("no such option, " + option);
  }
  return plan;
}

void print_recordings(const std::string& manifest) {
  for (const model::FieldRecording& recording : model::recordings_of(manifest))
    std::cout << recorded_row(recording);
}

std::string rows_of(std::uint64_t seed, std::size_t windows) {
  return windows > 1 ? window_rows(seed, windows) : simulated_row(seed);
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
               [&](std::size_t k) { rows[k] = rows_of(plan.seed + done + k, plan.windows); });
    for (const std::string& row : rows) std::cout << row;
    std::cout.flush();
  }
}

}  // namespace
}  // namespace loopscope::tests::verdict

int main(int argc, char** argv) {
  return loopscope::tests::run_program(argc, argv, loopscope::tests::verdict::run);
}
