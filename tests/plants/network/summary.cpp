#include "tests/plants/network/summary.hpp"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/plants/network/criteria.hpp"

namespace loopscope::tests::network {
namespace {

void count_source(const Outcome& outcome, Summary& summary) {
  ++summary.plants;
  if (outcome.found) ++summary.found;
  if (outcome.rank == 1) ++summary.source_first;
  if (outcome.rank >= 1 && outcome.rank <= 3) ++summary.source_top3;
  if (!outcome.named.empty()) ++summary.source_named;
  if (outcome.named == outcome.source) ++summary.named_right;
  if (outcome.rank != 1) summary.wrong.push_back(outcome);
  summary.by_criterion.resize(std::max(summary.by_criterion.size(), outcome.by_criterion.size()));
  for (std::size_t c = 0; c < outcome.by_criterion.size(); ++c)
    summary.by_criterion[c] += outcome.by_criterion[c];
}

void count_outside(const Outcome& outcome, Summary& summary) {
  ++summary.outside_plants;
  if (outcome.found) ++summary.outside_found;
  if (!outcome.named.empty()) ++summary.outside_named;
  if (!outcome.named.empty()) summary.wrong.push_back(outcome);
}

void count_loops(const Outcome& outcome, Summary& summary) {
  summary.carriers += outcome.carriers;
  summary.carriers_found += outcome.carriers_found;
  summary.members += outcome.members;
  summary.untouched += outcome.untouched;
  summary.victims_listed += outcome.victims_listed;
  summary.own_valves += outcome.own_valves;
  summary.own_valves_hidden += outcome.own_valves_hidden;
  summary.cascades += outcome.cascades;
  summary.cascades_found += outcome.cascades_found;
  summary.cascades_false += outcome.cascades_false;
}

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void add_row(std::ostringstream& text, const std::string& what, std::size_t part,
             std::size_t whole) {
  text << std::left << std::setw(52) << what << std::right << std::setw(5) << part << " of "
       << std::setw(5) << whole << std::setw(8) << std::fixed << std::setprecision(3)
       << share(part, whole) << "\n";
}

void add_wrong(std::ostringstream& text, const Outcome& outcome) {
  text << "  seed " << outcome.seed << (outcome.source.empty() ? ", outside" : "") << ": source "
       << (outcome.source.empty() ? "-" : outcome.source) << ", named "
       << (outcome.named.empty() ? "-" : outcome.named) << ", rank " << outcome.rank << "\n";
}

}  // namespace

Summary summarise(const std::vector<Outcome>& outcomes) {
  Summary summary;
  for (const Outcome& outcome : outcomes) {
    if (outcome.origin == Origin::outside)
      count_outside(outcome, summary);
    else
      count_source(outcome, summary);
    count_loops(outcome, summary);
    summary.plant_ms += outcome.plant_ms / static_cast<double>(outcomes.size());
  }
  return summary;
}

std::string table_of(const Summary& s) {
  std::ostringstream text;
  add_row(text, "plants with a source: shared oscillation found", s.found, s.plants);
  add_row(text, "  source ranked first", s.source_first, s.plants);
  add_row(text, "  source among the first three", s.source_top3, s.plants);
  add_row(text, "  a source named", s.source_named, s.plants);
  add_row(text, "  the named one right", s.named_right, s.source_named);
  add_row(text, "cause outside: shared oscillation found", s.outside_found, s.outside_plants);
  add_row(text, "  a source named falsely", s.outside_named, s.outside_plants);
  add_row(text, "loops that carry the oscillation: members", s.carriers_found, s.carriers);
  add_row(text, "  victims without a fault that stay on the list", s.victims_listed,
          s.carriers_found);
  add_row(text, "members with a sticking valve of their own: hidden", s.own_valves_hidden,
          s.own_valves);
  add_row(text, "members that the cause does not touch", s.untouched, s.members);
  add_row(text, "cascade pairs found", s.cascades_found, s.cascades);
  add_row(text, "  false ones", s.cascades_false, s.cascades_found + s.cascades_false);
  for (std::size_t c = 0; c < s.by_criterion.size(); ++c)
    text << "first by " << std::left << std::setw(43) << criterion_names()[c] << std::right
         << std::setw(22) << std::setprecision(3)
         << s.by_criterion[c] / static_cast<double>(std::max<std::size_t>(1, s.plants)) << "\n";
  text << "core/plant takes " << std::setprecision(0) << s.plant_ms << " ms a plant\n";
  if (!s.wrong.empty()) text << "wrong:\n";
  for (const Outcome& outcome : s.wrong) add_wrong(text, outcome);
  return text.str();
}

std::string json_of(const Summary& s) {
  nlohmann::ordered_json json = {{"plants", s.plants},
                                 {"source_first", s.source_first},
                                 {"source_top3", s.source_top3},
                                 {"source_named", s.source_named},
                                 {"named_right", s.named_right},
                                 {"found", s.found},
                                 {"outside_plants", s.outside_plants},
                                 {"outside_found", s.outside_found},
                                 {"outside_named", s.outside_named},
                                 {"carriers", s.carriers},
                                 {"carriers_found", s.carriers_found},
                                 {"members", s.members},
                                 {"members_untouched", s.untouched},
                                 {"victims_listed", s.victims_listed},
                                 {"own_valves", s.own_valves},
                                 {"own_valves_hidden", s.own_valves_hidden},
                                 {"cascades", s.cascades},
                                 {"cascades_found", s.cascades_found},
                                 {"cascades_false", s.cascades_false},
                                 {"plant_ms", s.plant_ms}};
  for (std::size_t c = 0; c < s.by_criterion.size(); ++c)
    json["first_by"][criterion_names()[c]] =
        s.by_criterion[c] / static_cast<double>(std::max<std::size_t>(1, s.plants));
  return json.dump(2) + "\n";
}

}  // namespace loopscope::tests::network
