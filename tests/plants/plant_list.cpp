#include <algorithm>
#include <iostream>
#include <thread>

#include "tests/plants/standing_list.hpp"
#include "tests/support/command_words.hpp"
#include "tests/support/in_threads.hpp"

namespace {

namespace plants = loopscope::tests::plants;
using loopscope::tests::CommandWords;
using loopscope::tests::WrongUsage;

constexpr const char* kUsage =
    "plant_list [--seed N] [--loops L] [--faulty F] [--windows W] [--threads T] [--json]\n"
    "    watches a plant over W windows (30) in slots of a tenth of a window; the faults begin\n"
    "    after three. Entries of each fault, false ones, and how long a fault waits. Defaults:\n"
    "    600 loops, 30 of them faulty, seed 1.\n";

struct Options {
  std::uint64_t seed = 1;
  plants::PlantSize size{600, 30};
  plants::Watch watch;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool help = false;
};

void set(Options& options, const std::string& option, std::uint64_t value) {
  if (option == "--seed")
    options.seed = value;
  else if (option == "--loops")
    options.size.loops = value;
  else if (option == "--faulty")
    options.size.faulty = value;
  else if (option == "--windows")
    options.watch.windows = value;
  else if (option == "--threads")
    options.threads = static_cast<unsigned>(std::max<std::uint64_t>(value, 1));
  else
    throw WrongUsage("unknown option " + option);
}

Options read_options(const std::vector<std::string>& words) {
  Options options;
  for (CommandWords left(words); !left.done();) {
    const std::string word = left.next();
    if (word == "--help")
      options.help = true;
    else if (word != "--json")
      set(options, word, left.number<std::uint64_t>(word, "a whole number"));
  }
  if (options.watch.windows <= options.watch.onset_windows)
    throw WrongUsage("--windows wants more than 3: the faults begin after so many");
  return options;
}

void run(const Options& options) {
  if (options.help) {
    std::cout << kUsage;
    return;
  }
  const auto plant = plants::draw_plant(options.seed, options.size);
  std::vector<plants::WatchedLoop> watched(plant.size());
  loopscope::tests::in_threads(plant.size(), options.threads, [&](std::size_t k) {
    watched[k] = plants::watch_loop(plant[k], options.watch);
  });
  std::cout << json_of(plants::run_list(plant, watched, options.watch));
}

}  // namespace

int main(int argc, char** argv) {
  return loopscope::tests::run_program(argc, argv,
                                       [](const auto& words) { run(read_options(words)); });
}
