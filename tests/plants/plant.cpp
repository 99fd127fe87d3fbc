#include "tests/plants/plant.hpp"

#include <algorithm>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tests/effects/random.hpp"
#include "tests/plants/fault_kinds.hpp"

namespace loopscope::tests::plants {
namespace {

using effects::Random;

/// Flow and pressure answer within a minute, heat and composition do not.
constexpr double kFastProcess_s = 60.0;

int last(std::size_t count) {
  return static_cast<int>(count) - 1;
}

void shuffle(std::vector<std::size_t>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i)
    std::swap(values[i - 1], values[static_cast<std::size_t>(random.whole(0, last(i)))]);
}

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> values(count);
  std::iota(values.begin(), values.end(), std::size_t{0});
  shuffle(values, random);
  return values;
}

std::string name_of(std::size_t number) {
  std::ostringstream name;
  name << 'L' << std::setw(3) << std::setfill('0') << number + 1;
  return name.str();
}

PlantLoop healthy_loop(std::size_t number, Random& random) {
  PlantLoop loop;
  loop.name = name_of(number);
  loop.record = random.chance(0.5) ? "healthy_still" : "healthy_moving";
  loop.seed = random.next();
  // Most loops are as important as any other, a few carry the plant.
  loop.importance = random.pick({0.5, 1.0, 1.0, 1.0, 2.0, 5.0});
  return loop;
}

void make_faulty(PlantLoop& loop, const FaultKind& kind, Random& random) {
  loop.fault = kind.verdict;
  loop.record = kind.records[static_cast<std::size_t>(random.whole(0, last(kind.records.size())))];
}

}  // namespace

std::vector<PlantLoop> draw_plant(std::uint64_t seed, PlantSize size) {
  if (size.faulty > size.loops) throw std::invalid_argument("more faulty loops than loops");
  Random random(effects::seed_for("plant", seed));
  std::vector<PlantLoop> plant;
  for (std::size_t i = 0; i < size.loops; ++i) plant.push_back(healthy_loop(i, random));
  const auto kinds = fault_kinds();
  const std::vector<std::size_t> places = shuffled(size.loops, random);
  const std::vector<std::size_t> order = shuffled(kinds.size(), random);
  for (std::size_t i = 0; i < size.faulty; ++i)
    make_faulty(plant[places[i]], kinds[order[i % order.size()]], random);
  return plant;
}

effects::Record record_of(const PlantLoop& loop, std::uint64_t stretch) {
  return effects::generate_stretch(loop.record, loop.seed, stretch);
}

std::string loop_type(const PlantLoop& loop, const effects::Record& record) {
  if (record.truth.loop.integrating) return "level";
  const bool first = Random(effects::seed_for("type", loop.seed)).chance(0.5);
  if (record.truth.loop.time_constant_s < kFastProcess_s) return first ? "flow" : "pressure";
  return first ? "temperature" : "concentration";
}

}  // namespace loopscope::tests::plants
