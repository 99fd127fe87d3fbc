#include <iostream>

#include "tests/plants/diagnosed_loop.hpp"
#include "tests/plants/flags.hpp"
#include "tests/plants/plant_faults_options.hpp"
#include "tests/plants/score_text.hpp"
#include "tests/plants/write_plant.hpp"
#include "tests/support/command_words.hpp"

namespace {

namespace plants = loopscope::tests::plants;

void print(const plants::Options& options, const std::vector<plants::SeedScore>& scores) {
  std::cout << (options.json ? plants::json_of(scores) : plants::table_of(scores));
}

void diagnose(const plants::Options& options) {
  std::vector<plants::SeedScore> scores;
  for (std::uint64_t seed = options.seed; seed < options.seed + options.plants; ++seed) {
    const auto plant = plants::draw_plant(seed, options.size);
    const auto diagnosed = plants::diagnose_plant(plant, options.threads, options.without);
    scores.push_back(
        {seed, plants::score(plant, plants::flags_of(plant, diagnosed, options.rule))});
  }
  print(options, scores);
}

void run(const plants::Options& options) {
  const auto plant = [&] { return plants::draw_plant(options.seed, options.size); };
  switch (options.task) {
    case plants::Options::Task::help:
      std::cout << plants::usage();
      break;
    case plants::Options::Task::diagnose:
      diagnose(options);
      break;
    case plants::Options::Task::history:
      plants::write_history(std::cout, plant(), 0, options.end_us);
      break;
    case plants::Options::Task::earlier_history:
      plants::write_history(std::cout, plants::watched_before(plant()), 1, options.end_us);
      break;
    case plants::Options::Task::catalogue:
      plants::write_catalogue(std::cout, plant());
      break;
    case plants::Options::Task::earlier_catalogue:
      plants::write_catalogue(std::cout, plants::watched_before(plant()));
      break;
    case plants::Options::Task::score:
      print(options, {{options.seed, plants::score(plant(), plants::read_flags(std::cin))}});
      break;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return loopscope::tests::run_program(argc, argv,
                                       [](const auto& words) { run(plants::read_options(words)); });
}
