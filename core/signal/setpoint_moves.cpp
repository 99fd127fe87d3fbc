#include "core/signal/setpoint_moves.hpp"

#include <cmath>
#include <optional>

#include "core/signal/order/spread.hpp"

namespace loopscope::core::signal {
namespace {

void add_move(std::vector<SetpointMove>& moves, std::size_t from, std::size_t to, double size) {
  const bool goes_on = !moves.empty() && moves.back().last == from && moves.back().size * size > 0;
  if (goes_on) {
    moves.back().last = to;
    moves.back().size += size;
  } else {
    moves.push_back({to, to, size});
  }
}

template <typename InManual>
std::vector<SetpointMove> find_moves(std::span<const double> sp, InManual in_manual) {
  std::vector<SetpointMove> moves;
  std::optional<std::size_t> before;
  bool from_manual = false;
  for (std::size_t k = 0; k < sp.size(); ++k) {
    if (in_manual(k)) {
      before.reset();
      from_manual = true;
    } else if (std::isfinite(sp[k])) {
      const double size = before ? sp[k] - sp[*before] : 0.0;
      if (size != 0.0) add_move(moves, *before, k, size);
      if (from_manual) moves.push_back({k, k, kUnknownSize});
      before = k;
      from_manual = false;
    }
  }
  return moves;
}

}  // namespace

std::vector<SetpointMove> find_setpoint_moves(const PreparedLoop& loop) {
  return find_moves(loop.sp, [&](std::size_t k) {
    return !loop.mode.empty() && loop.mode[k] == ControlMode::manual;
  });
}

std::vector<SetpointMove> find_setpoint_moves(std::span<const double> sp) {
  return find_moves(sp, [](std::size_t) { return false; });
}

bool moves_most_of_the_time(std::span<const double> sp) {
  constexpr double kMostSamples = 0.5;
  return share_of_moves(sp) > kMostSamples;
}

}  // namespace loopscope::core::signal
