#include "tests/plants/process/judgement_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/plants/process/names.hpp"

namespace loopscope::tests::process {
namespace {

constexpr std::size_t kBins = 5;

struct Row {
  double plants = 0.0, with_event = 0.0, found = 0.0, first = 0.0, named = 0.0, right = 0.0;
  double carriers = 0.0, carriers_found = 0.0, members = 0.0, untouched = 0.0;

  void add(const Judgement& one) {
    plants += 1.0, with_event += one.events > 0 ? 1.0 : 0.0, found += one.found ? 1.0 : 0.0;
    first += one.source_first ? 1.0 : 0.0, named += one.named ? 1.0 : 0.0;
    right += one.named_right ? 1.0 : 0.0;
    carriers += static_cast<double>(one.carriers);
    carriers_found += static_cast<double>(one.carriers_found);
    members += static_cast<double>(one.members);
    untouched += static_cast<double>(one.untouched);
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(),
                  "%-16s%7.0f%8.0f%8.0f%8.0f%8.0f%8.0f%7.0f/%-5.0f%7.0f/%-5.0f\n", name.c_str(),
                  plants, with_event, found, first, named, right, carriers_found, carriers,
                  untouched, members);
    return line.data();
  }
};

}  // namespace

double calibration_error(const std::vector<Judgement>& judgements) {
  std::array<double, kBins> count{}, odds{}, right{};
  double all = 0.0, error = 0.0;
  for (const Judgement& one : judgements) {
    if (!one.found) continue;
    const auto bin =
        std::min(kBins - 1, static_cast<std::size_t>(one.first_odds * static_cast<double>(kBins)));
    count[bin] += 1.0, odds[bin] += one.first_odds, right[bin] += one.first_right ? 1.0 : 0.0;
    all += 1.0;
  }
  for (std::size_t bin = 0; bin < kBins; ++bin) error += std::abs(odds[bin] - right[bin]);
  return all > 0.0 ? error / all : 0.0;
}

std::string table_of(const std::vector<Judgement>& judgements) {
  std::map<Cause, Row> rows;
  Row sources;
  for (const Judgement& one : judgements) {
    rows[one.cause].add(one);
    if (one.cause != Cause::none && one.cause != Cause::outside_wave) sources.add(one);
  }
  std::string text =
      "cause           plants  events   found   first   named   right  carriers     untouched\n";
  for (const auto& [cause, row] : rows) text += row.text(name_of(cause));
  text += sources.text("with a source");
  std::array<char, 80> line{};
  std::snprintf(line.data(), line.size(), "source first %.3f, calibration error %.3f\n",
                sources.first / std::max(1.0, sources.plants), calibration_error(judgements));
  return text + line.data();
}

}  // namespace loopscope::tests::process
