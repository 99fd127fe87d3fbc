#include "daemon/commands/option_values.hpp"

#include <cmath>

#include "daemon/failure.hpp"
#include "daemon/recording/cells.hpp"

namespace loopscope::daemon {

std::optional<core::signal::OpRange> parse_op_range(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t comma = text.find(',');
  const auto low = parse_number(text.substr(0, comma));
  const auto high =
      comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
  if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high) {
    return core::signal::OpRange{*low, *high};
  }
  throw Failure(ExitCode::usage, "op range \"" + text + "\" is not LOW,HIGH with LOW below HIGH",
                "e.g. --op-range 4,20 for milliamperes");
}

}  // namespace loopscope::daemon
