#include "core/model/valve_law/valve_between_samples.hpp"

#include <cmath>
#include <cstddef>

#include "core/model/valve_law/stems-inl.hpp"

namespace loopscope::core::model {
namespace {

template <ValveLaw law>
void follow(Stems<double> stem, double first_op, std::span<const double> op, std::span<double> mv) {
  double place = first_op;
  for (std::size_t k = 0; k < op.size(); ++k) {
    if (!std::isnan(op[k])) {
      stem.step<law>(op[k]);
      place = stem.place();
    }
    mv[k] = place;
  }
}

}  // namespace

void run_between_samples(const Valve& valve, double first_op, std::span<const double> op,
                         std::span<double> mv) {
  Stems<double> stem;
  stem.put_in(0, valve, first_op);
  const double before = valve.start_percent.value_or(first_op);
  if (valve.law == ValveLaw::he) return follow<ValveLaw::he>(stem, before, op, mv);
  follow<ValveLaw::kano>(stem, before, op, mv);
}

}  // namespace loopscope::core::model
