#include <cstdio>
#include <string>
#include <vector>

#include "core/model/effects/effect_catalogue.hpp"
#include "core/model/results/explanation.hpp"
#include "tests/core/model/trial_records.hpp"
#include "tests/tables/table.hpp"

namespace loopscope::core::model {
namespace {

using tests::absent_effects;
using tests::p_without;
using tests::share_below;

LOOPSCOPE_TABLE(trial_sizes, "shares of p at most 0.05, 0.01, 0.001 where nothing is there") {
  for (const EffectPtr& effect : absent_effects()) {
    for (const bool once : {false, true}) {
      const std::vector<double> p = p_without(effect, once, 2000);
      std::printf("| %s%s | %.4f | %.4f | %.4f |\n", std::string(name(effect->kind())).c_str(),
                  once ? ", once" : "", share_below(p, 0.05), share_below(p, 0.01),
                  share_below(p, 0.001));
    }
  }
}

}  // namespace
}  // namespace loopscope::core::model
