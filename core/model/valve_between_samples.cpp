#include "core/model/valve_between_samples.hpp"

#include <cmath>
#include <cstddef>

#include "core/model/stems.hpp"

namespace loopscope::core::model {
namespace {

template <ValveLaw law>
void follow(Stems<double> stem, double first_op, std::span<const ValveRestart> restarts,
            std::span<const double> op, std::span<double> mv) {
  double place = first_op;
  std::size_t next = 0;
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (next < restarts.size() && restarts[next].at_sample == k) {
      place = restarts[next++].position_percent;
      stem.put(0, place);
    }
    if (!std::isnan(op[k])) {
      stem.step<law>(op[k]);
      place = stem.place();
    }
    mv[k] = place;
  }
}

}  // namespace

void run_between_samples(const Valve& valve, double first_op,
                         std::span<const ValveRestart> restarts, std::span<const double> op,
                         std::span<double> mv) {
  Stems<double> stem;
  stem.put_in(0, valve, first_op);
  if (valve.law == ValveLaw::he) return follow<ValveLaw::he>(stem, first_op, restarts, op, mv);
  follow<ValveLaw::kano>(stem, first_op, restarts, op, mv);
}

}  // namespace loopscope::core::model
