#include "daemon/service/windows/loop_input.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace loopscope::daemon {

LoopInput prepare_input(LoopWindowAtSlot at_slot, const core::AnalysisSettings& settings) {
  core::FirstLook first = core::first_look(at_slot.window, settings);
  return {std::move(at_slot), std::move(first), std::nullopt};
}

void read_longer_spans(storage::HistorianReader& historian, std::span<const InputOfLoop> inputs,
                       RowMemory& memory) {
  std::vector<SpanRequest> requests;
  std::vector<LoopInput*> asking;
  for (const InputOfLoop& of_loop : inputs) {
    if (!of_loop.wants_longer_span()) continue;
    LoopInput& input = *of_loop.input;
    requests.push_back({of_loop.loop, &input.at_slot, input.first.slow_span_samples});
    asking.push_back(&input);
  }
  std::vector<core::signal::LoopWindow> windows = read_spans(historian, requests, memory);
  for (std::size_t k = 0; k < asking.size(); ++k) asking[k]->long_window = std::move(windows[k]);
}

LoopInput read_input(storage::HistorianReader& historian, const LoopSlot& slot,
                     const core::AnalysisSettings& settings) {
  RowMemory memory;
  auto windows =
      read_windows(historian, std::span(&slot, 1), settings.prepare.window_samples, memory);
  LoopInput input = prepare_input(std::move(windows.front()), settings);
  const std::array wish{InputOfLoop{slot.loop, &input}};
  read_longer_spans(historian, wish, memory);
  return input;
}

}  // namespace loopscope::daemon
