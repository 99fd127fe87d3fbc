#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/results/mechanism.hpp"
#include "tests/plants/flags.hpp"
#include "tests/plants/plant.hpp"

namespace loopscope::tests::plants {

struct Options {
  enum class Task { diagnose, help, history, earlier_history, catalogue, earlier_catalogue, score };
  Task task = Task::diagnose;
  std::uint64_t seed = 1;
  std::size_t plants = 1;
  PlantSize size;
  FlagRule rule;
  core::model::Without without;  ///< parts of the model's search
  unsigned threads = 1;
  std::int64_t end_us = 0;  ///< time of the newest sample
  bool json = false;
};

/// `words` = without the program's name. Throws WrongUsage.
[[nodiscard]] Options read_options(const std::vector<std::string>& words);

[[nodiscard]] std::string usage();

}  // namespace loopscope::tests::plants
