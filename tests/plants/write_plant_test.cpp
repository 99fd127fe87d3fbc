#include "tests/plants/write_plant.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

namespace loopscope::tests::plants {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

struct Row {
  std::string tag;
  std::int64_t time_us = 0;
  double value = 0.0;
};

Row row_of(const std::string& line) {
  Row row;
  std::istringstream(line) >> row.tag >> row.time_us >> row.value;
  return row;
}

std::vector<std::string> history_of(const std::vector<PlantLoop>& plant, std::uint64_t stretch) {
  std::ostringstream out;
  write_history(out, plant, stretch, 1'000'000'000'000'000);
  return lines_of(out.str());
}

TEST(WritePlant, TheLastSampleLiesAtTheEndAndValuesAreExact) {
  const std::vector<PlantLoop> plant = draw_plant(3, {1, 0});
  const effects::Record record = record_of(plant.front());
  const std::vector<std::string> lines = history_of(plant, 0);
  ASSERT_EQ(lines.size(), 3 * record.pv.size());
  const Row last = row_of(lines.back());
  EXPECT_EQ(last.tag, "L001.OP");
  EXPECT_EQ(last.time_us, 1'000'000'000'000'000);
  EXPECT_EQ(last.value, record.op.back());
  EXPECT_EQ(row_of(lines[record.pv.size()]).value, record.pv.front());
}

TEST(WritePlant, TheStretchBeforeEndsASampleBeforeTheNewestBegins) {
  const std::vector<PlantLoop> plant = draw_plant(3, {1, 0});
  const double interval_s = record_of(plant.front()).interval_s;
  const std::int64_t first = row_of(history_of(plant, 0).front()).time_us;
  const std::int64_t before = row_of(history_of(plant, 1).back()).time_us;
  EXPECT_EQ(first - before, static_cast<std::int64_t>(interval_s * 1e6));
}

TEST(WritePlant, TheCatalogueHoldsNoTruth) {
  const std::vector<PlantLoop> plant = draw_plant(3, {8, 8});
  std::ostringstream out;
  write_catalogue(out, plant);
  EXPECT_EQ(lines_of(out.str()).size(), 9U);
  for (const PlantLoop& loop : plant) {
    EXPECT_EQ(out.str().find(loop.fault), std::string::npos);
    EXPECT_NE(out.str().find(loop.name + ".PV"), std::string::npos);
  }
}

TEST(WritePlant, FaultyLoopsAndAsManyHealthyOnesAreWatchedTwice) {
  const std::vector<PlantLoop> watched = watched_before(draw_plant(3));
  EXPECT_EQ(watched.size(), 50U);
  EXPECT_EQ(std::count_if(watched.begin(), watched.end(),
                          [](const PlantLoop& loop) { return loop.is_faulty(); }),
            25);
}

}  // namespace
}  // namespace loopscope::tests::plants
