#include "tests/plants/score_text.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace loopscope::tests::plants {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRightShare = 22.0 / 25.0;
constexpr double kFalseShare = 2.0 / 25.0;

std::map<std::string, FaultScore> all_faults(const std::vector<SeedScore>& scores) {
  std::map<std::string, FaultScore> sum;
  for (const SeedScore& one : scores)
    for (const auto& [name, fault] : one.score.by_fault) {
      FaultScore& total = sum[name];
      total.faulty += fault.faulty;
      total.right += fault.right;
      total.wrong += fault.wrong;
      total.unnamed += fault.unnamed;
    }
  return sum;
}

Json faults_json(const std::map<std::string, FaultScore>& faults) {
  Json json = Json::object();
  for (const auto& [name, fault] : faults)
    json[name] = {{"faulty", fault.faulty},
                  {"right", fault.right},
                  {"wrong", fault.wrong},
                  {"unnamed", fault.unnamed}};
  return json;
}

Json plant_json(const SeedScore& one) {
  const PlantScore& score = one.score;
  return {{"seed", one.seed},           {"loops", score.loops},
          {"faulty", score.faulty},     {"right", score.right},
          {"false", score.false_flags}, {"false_healthy", score.false_healthy},
          {"holds", holds(score)},      {"faults", faults_json(score.by_fault)},
          {"misses", score.misses}};
}

std::size_t count_holding(const std::vector<SeedScore>& scores) {
  return static_cast<std::size_t>(std::count_if(
      scores.begin(), scores.end(), [](const SeedScore& one) { return holds(one.score); }));
}

}  // namespace

bool holds(const PlantScore& score) {
  const auto faulty = static_cast<double>(score.faulty);
  return static_cast<double>(score.right) >= std::floor(kRightShare * faulty + 1e-9) &&
         static_cast<double>(score.false_flags) <= std::ceil(kFalseShare * faulty - 1e-9);
}

std::string table_of(const std::vector<SeedScore>& scores) {
  std::ostringstream out;
  out << "seed      loops  faulty  right  false  of them healthy\n";
  for (const auto& [seed, score] : scores)
    out << std::left << std::setw(10) << seed << std::right << std::setw(5) << score.loops
        << std::setw(8) << score.faulty << std::setw(7) << score.right << std::setw(7)
        << score.false_flags << std::setw(17) << score.false_healthy << "\n";
  out << "holds in " << count_holding(scores) << " of " << scores.size() << "\n\n"
      << "fault                  faulty  right  wrong  unnamed\n";
  for (const auto& [name, fault] : all_faults(scores))
    out << std::left << std::setw(23) << name << std::right << std::setw(6) << fault.faulty
        << std::setw(7) << fault.right << std::setw(7) << fault.wrong << std::setw(9)
        << fault.unnamed << "\n";
  out << "\n";
  for (const SeedScore& one : scores)
    for (const std::string& miss : one.score.misses) out << one.seed << " " << miss << "\n";
  return out.str();
}

std::string json_of(const std::vector<SeedScore>& scores) {
  Json json = {{"holding", count_holding(scores)}, {"faults", faults_json(all_faults(scores))}};
  json["plants"] = Json::array();
  for (const SeedScore& one : scores) json["plants"].push_back(plant_json(one));
  return json.dump(2) + "\n";
}

Flags read_flags(std::istream& lines) {
  Flags flags;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, verdict, more;
    if (!(words >> name >> verdict) || words >> more)
      throw std::invalid_argument("not a loop and its verdict: " + line);
    flags[name] = verdict;
  }
  return flags;
}

}  // namespace loopscope::tests::plants
