#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/effects/draws.hpp"

namespace loopscope::tests::effects {

struct Options {
  bool help = false;
  bool list = false;
  bool json = false;
  bool records = false;         ///< a line of JSON for each draw instead of the summary
  bool residual_tests = false;  ///< how often each passes, instead of diagnoses
  Plan plan;
  std::string dump_kind;  ///< not empty: write one record instead of running draws
  std::uint64_t dump_seed = 0;
  std::string dump_file;  ///< "-" = standard output
  bool with_mv = false;
  bool field = false;    ///< the families of field recordings instead of kinds
  std::string manifest;  ///< not empty: the recordings that it lists
};

/// `words` = without the program's name. Throws WrongUsage.
[[nodiscard]] Options read_options(const std::vector<std::string>& words);

/// A word of --without. Throws WrongUsage.
[[nodiscard]] core::model::Mechanism read_mechanism(const std::string& name);

[[nodiscard]] std::string usage();

}  // namespace loopscope::tests::effects
