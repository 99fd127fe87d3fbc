#include "daemon/service/windows/loop_input.hpp"

#include <chrono>
#include <exception>
#include <utility>

namespace loopscope::daemon {
namespace {

void look_first(LoopInput& input, const core::AnalysisSettings& settings) {
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto start = std::chrono::steady_clock::now();
  try {
    input.first = core::first_look(input.at_slot.window, settings);
  } catch (const std::exception&) {
    input.first.reset();
  }
  input.first_look_ms = Milliseconds(std::chrono::steady_clock::now() - start).count();
}

void read_long_windows(storage::HistorianReader& historian, std::span<const LoopSlot> slots,
                       RowMemory& memory, std::vector<LoopInput>& inputs) {
  std::vector<SpanRequest> requests;
  std::vector<LoopInput*> asking;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const std::size_t samples = inputs[k].first ? inputs[k].first->slow_span_samples : 0;
    if (samples == 0) continue;
    requests.push_back({slots[k].loop, &inputs[k].at_slot, samples});
    asking.push_back(&inputs[k]);
  }
  std::vector<core::signal::LoopWindow> windows = read_spans(historian, requests, memory);
  for (std::size_t k = 0; k < asking.size(); ++k) asking[k]->long_window = std::move(windows[k]);
}

}  // namespace

std::vector<LoopInput> read_inputs(storage::HistorianReader& historian,
                                   std::span<const LoopSlot> slots,
                                   const core::AnalysisSettings& settings, RowMemory& memory,
                                   const AnalysisContext& place) {
  std::vector<LoopInput> inputs;
  for (LoopWindowAtSlot& at_slot :
       read_windows(historian, slots, settings.prepare.window_samples, memory)) {
    inputs.emplace_back().at_slot = std::move(at_slot);
  }
  {
    const CoreGate::Permit core = take_core(place);
    for (LoopInput& input : inputs) {
      look_first(input, settings);
      place.desk.step();
    }
  }
  read_long_windows(historian, slots, memory, inputs);
  return inputs;
}

}  // namespace loopscope::daemon
