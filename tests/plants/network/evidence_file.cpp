#include "tests/plants/network/evidence_file.hpp"

namespace loopscope::tests::network {

void write_evidence(std::ostream& out, const std::vector<Outcome>& outcomes) {
  out << "plant,source,height,setpoint,op,lead,direct,friction,outside,no_leader,cubic\n";
  for (const Outcome& outcome : outcomes)
    for (const Outcome::Figures& member : outcome.figures) {
      out << (outcome.origin == Origin::outside ? "outside_" : "valve_") << outcome.seed << ','
          << (member.is_source ? 1 : 0);
      for (const double value : member.values) out << ',' << value;
      for (const double value : outcome.none) out << ',' << value;
      out << '\n';
    }
}

}  // namespace loopscope::tests::network
