#include "storage/results/plant/plant_picture.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace loopscope::storage {
namespace {

std::string five_digits(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 5);
  return {text.data(), end.ptr};
}

std::string json_array(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() > 1 ? "," : "") + five_digits(value);
  return text + "]";
}

std::string lead_json(const PlantLead& lead) {
  return R"({"from_loop_id":)" + std::to_string(lead.from_loop_id) + R"(,"to_loop_id":)" +
         std::to_string(lead.to_loop_id) + R"(,"gain":)" + five_digits(lead.gain) +
         R"(,"direct":)" + five_digits(lead.direct) + "}";
}

std::string trace_json(const PlantTrace& trace) {
  return R"({"loop_id":)" + std::to_string(trace.loop_id) + R"(,"start_us":)" +
         std::to_string(trace.start_us) + R"(,"step_s":)" + five_digits(trace.step_s) +
         R"(,"error":)" + json_array(trace.error) + R"(,"periods_s":)" +
         json_array(trace.periods_s) + R"(,"power":)" + json_array(trace.power) + "}";
}

template <typename Value>
std::string json_list(std::span<const Value> values, std::string (*json)(const Value&)) {
  std::string text = "[";
  for (const Value& value : values) text += (text.size() > 1 ? "," : "") + json(value);
  return text + "]";
}

}  // namespace

std::string leads_json(std::span<const PlantLead> leads) {
  return json_list(leads, lead_json);
}

std::string traces_json(std::span<const PlantTrace> traces) {
  return json_list(traces, trace_json);
}

}  // namespace loopscope::storage
