#include "tests/plants/write_plant.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

namespace loopscope::tests::plants {
namespace {

constexpr double kMicroseconds = 1e6;
template <typename Number>
void append(std::string& text, Number number) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), end);
}

void write_series(std::ostream& out, const std::string& tag, const std::vector<double>& values,
                  std::int64_t first_us, std::int64_t step_us) {
  std::string rows;
  for (std::size_t k = 0; k < values.size(); ++k) {
    rows.append(tag).push_back('\t');
    append(rows, first_us + static_cast<std::int64_t>(k) * step_us);
    rows.push_back('\t');
    append(rows, values[k]);
    rows.push_back('\n');
  }
  out << rows;
}

}  // namespace

void write_history(std::ostream& out, const std::vector<PlantLoop>& loops, std::uint64_t stretch,
                   std::int64_t end_us) {
  for (const PlantLoop& loop : loops) {
    const effects::Record record = record_of(loop, stretch);
    const auto step_us = static_cast<std::int64_t>(std::llround(record.interval_s * kMicroseconds));
    const auto samples = static_cast<std::int64_t>(record.pv.size());
    const std::int64_t first_us =
        end_us - (samples * static_cast<std::int64_t>(stretch + 1) - 1) * step_us;
    write_series(out, loop.name + ".SP", record.sp, first_us, step_us);
    write_series(out, loop.name + ".PV", record.pv, first_us, step_us);
    write_series(out, loop.name + ".OP", record.op, first_us, step_us);
  }
}

void write_catalogue(std::ostream& out, const std::vector<PlantLoop>& loops) {
  out << "name,source,sp_tag,pv_tag,op_tag,interval_s,period_s,op_low,op_high,loop_type,"
         "importance\n";
  for (const PlantLoop& loop : loops) {
    const effects::Record record = record_of(loop);
    const double period_s = record.interval_s * static_cast<double>(record.pv.size());
    out << loop.name << ",plant," << loop.name << ".SP," << loop.name << ".PV," << loop.name
        << ".OP," << record.interval_s << ',' << period_s << ",0,100," << loop_type(loop, record)
        << ',' << loop.importance << '\n';
  }
}

std::vector<PlantLoop> watched_before(const std::vector<PlantLoop>& plant) {
  const auto faulty = std::count_if(plant.begin(), plant.end(),
                                    [](const PlantLoop& loop) { return loop.is_faulty(); });
  std::vector<PlantLoop> watched;
  std::ptrdiff_t healthy = 0;
  for (const PlantLoop& loop : plant)
    if (loop.is_faulty() || healthy++ < faulty) watched.push_back(loop);
  return watched;
}

}  // namespace loopscope::tests::plants
