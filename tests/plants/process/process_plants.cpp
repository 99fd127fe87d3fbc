#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/plants/process/names.hpp"
#include "tests/plants/process/write_plant_files.hpp"

namespace {

namespace process = loopscope::tests::process;

constexpr const char* kUsage =
    "process_plants --kind KIND --cause CAUSE [--seed N] [--csv DIR]\n"
    "Draws one plant and writes a CSV per loop and truth.json into DIR; without --csv the truth\n"
    "goes to the standard output.\n"
    "KIND: evaporator, reactor_recycle, column, four_tanks\n"
    "CAUSE: none, sticking_valve, dead_band, sawtooth_sensor, tight_loop, outside_wave\n";

std::map<std::string, std::string> read_words(int count, char** words) {
  std::map<std::string, std::string> options = {{"--seed", "1"}, {"--csv", ""}};
  for (int i = 1; i < count; i += 2) {
    const std::string name = words[i];
    if (i + 1 >= count ||
        (name != "--kind" && name != "--cause" && name != "--seed" && name != "--csv"))
      throw std::invalid_argument(kUsage);
    options[name] = words[i + 1];
  }
  return options;
}

void draw(std::map<std::string, std::string> options) {
  const process::ProcessPlant plant = process::draw_process_plant(
      process::kind_named(options["--kind"]), process::cause_named(options["--cause"]),
      std::stoull(options["--seed"]));
  if (options["--csv"].empty())
    std::cout << process::truth_json(plant);
  else
    process::write_plant_files(plant, options["--csv"]);
}

}  // namespace

int main(int count, char** words) {
  try {
    draw(read_words(count, words));
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
