#include "tests/storage/results/lease_steps.hpp"

namespace loopscope::storage {

std::ostream& operator<<(std::ostream& out, const Step& step) {
  return out << "{" << static_cast<int>(step.deed) << ", " << step.worker << ", " << step.which
             << "}";
}

rc::Gen<Step> any_step() {
  using rc::gen::just;
  const auto deed = rc::gen::weightedElement<Deed>({{6, Deed::claim},
                                                    {3, Deed::claim_next},
                                                    {3, Deed::claim_suspect},
                                                    {6, Deed::complete},
                                                    {1, Deed::complete_without_row},
                                                    {3, Deed::fail},
                                                    {2, Deed::release},
                                                    {2, Deed::extend},
                                                    {3, Deed::repeat},
                                                    {8, Deed::stall},
                                                    {4, Deed::be_due}});
  return rc::gen::construct<Step>(deed, rc::gen::inRange<std::size_t>(0, kLeaseWorkers),
                                  rc::gen::inRange<std::size_t>(0, 12));
}

}  // namespace loopscope::storage
