#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/plants/flags.hpp"
#include "tests/plants/plant.hpp"

namespace loopscope::tests::plants {

/// A command line that cannot be understood; the message names the word.
struct WrongUsage : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

struct Options {
  enum class Task { diagnose, help, history, earlier_history, catalogue, earlier_catalogue, score };
  Task task = Task::diagnose;
  std::uint64_t seed = 1;
  std::size_t plants = 1;
  PlantSize size;
  FlagRule rule;
  unsigned threads = 1;
  std::int64_t end_us = 0;  ///< time of the newest sample
  bool json = false;
};

/// `words` = without the program's name.
[[nodiscard]] Options read_options(const std::vector<std::string>& words);

[[nodiscard]] std::string usage();

}  // namespace loopscope::tests::plants
