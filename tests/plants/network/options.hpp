#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace loopscope::tests::network {

/// Plants `seed` to `seed + plants - 1`; those with a cause outside have the same numbers and share
/// nothing with them.
struct Options {
  bool help = false;
  bool json = false;
  bool criteria = false;      ///< also what each criterion alone would rank first
  std::string evidence_file;  ///< the ranking's figures of every member; empty = not written
  std::uint64_t seed = 1;
  std::size_t plants = 40;      ///< with a sticking valve as the source
  std::size_t outside = 10;     ///< with the cause outside
  std::size_t independent = 0;  ///< instead: plants of loops that share nothing
  unsigned threads = 1;
};

/// `words` = without the program's name. Throws WrongUsage.
[[nodiscard]] Options read_options(const std::vector<std::string>& words);

[[nodiscard]] std::string usage();

}  // namespace loopscope::tests::network
