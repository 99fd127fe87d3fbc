#include "tests/plants/process/write_plant_files.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/plants/process/names.hpp"

namespace loopscope::tests::process {
namespace {

void write_field(std::ostream& out, double value) {
  out << ',';
  if (!std::isnan(value)) out << value;
}

void write_loop(std::ostream& out, const ProcessLoop& loop) {
  out.precision(9);
  out << "t_s,sp,pv,op\n";
  for (std::size_t k = 0; k < loop.pv.size(); ++k) {
    out << loop.start_s + loop.interval_s * static_cast<double>(k);
    write_field(out, loop.sp[k]);
    write_field(out, loop.pv[k]);
    write_field(out, loop.op[k]);
    out << '\n';
  }
}

nlohmann::ordered_json loop_json(const ProcessLoop& loop) {
  return {{"name", loop.name},
          {"type", loop.type},
          {"integrating", loop.integrating},
          {"interval_s", loop.interval_s},
          {"start_s", loop.start_s},
          {"samples", loop.pv.size()},
          {"low", loop.low},
          {"high", loop.high},
          {"share", loop.share},
          {"pv_share", loop.pv_share},
          {"line_share", loop.line_share},
          {"carries", loop.carries}};
}

}  // namespace

std::string truth_json(const ProcessPlant& plant) {
  nlohmann::ordered_json json = {{"kind", name_of(plant.kind)},
                                 {"cause", name_of(plant.cause)},
                                 {"period_s", plant.period_s},
                                 {"source", nullptr},
                                 {"drafts", plant.drafts}};
  if (plant.source) json["source"] = plant.loops[*plant.source].name;
  json["cascades"] = nlohmann::ordered_json::array();
  for (const auto& [master, slave] : plant.cascades)
    json["cascades"].push_back({plant.loops[master].name, plant.loops[slave].name});
  json["loops"] = nlohmann::ordered_json::array();
  for (const ProcessLoop& loop : plant.loops) json["loops"].push_back(loop_json(loop));
  return json.dump(1) + "\n";
}

void write_plant_files(const ProcessPlant& plant, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const ProcessLoop& loop : plant.loops) {
    std::ofstream file(folder / (loop.name + ".csv"));
    write_loop(file, loop);
    if (!file.flush()) throw std::runtime_error("cannot write into " + folder.string());
  }
  std::ofstream(folder / "truth.json") << truth_json(plant);
}

}  // namespace loopscope::tests::process
