#include "tests/plants/network/evidence_file.hpp"

namespace loopscope::tests::network {

void write_evidence(std::ostream& out, const std::vector<Outcome>& outcomes) {
  out << "plant,source,height,blamed,cubic,ext,setpoint,op,lead,direct,no_leader\n";
  for (const Outcome& outcome : outcomes)
    for (const Outcome::Figures& member : outcome.figures) {
      out << (outcome.origin == Origin::outside ? "outside_" : "valve_") << outcome.seed << ','
          << (member.is_source ? 1 : 0);
      for (const double value : member.values) out << ',' << value;
      out << ',' << outcome.no_leader << '\n';
    }
}

}  // namespace loopscope::tests::network
