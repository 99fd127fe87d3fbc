#include "daemon/reproduce/reproduction.hpp"

namespace loopscope::daemon {

Reproduction reproduce_paper(std::size_t seeds) {
  Reproduction reproduction;
  reproduction.seeds = seeds;
  for (const Example& example : paper_examples()) {
    reproduction.examples.push_back({example, measure(example, seeds)});
  }
  return reproduction;
}

}  // namespace loopscope::daemon
