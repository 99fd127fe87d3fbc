#include "daemon/commands/option_values.hpp"

#include <cmath>

#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {

namespace {

/// `what` is named in the error.
std::optional<core::signal::OpRange> parse_range(const std::string& text, const std::string& what,
                                                 const char* hint) {
  if (text.empty()) return std::nullopt;
  const std::size_t comma = text.find(',');
  const auto low = parse_number(text.substr(0, comma));
  const auto high =
      comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
  if (low && high && std::isfinite(*low) && std::isfinite(*high) && *low < *high) {
    return core::signal::OpRange{*low, *high};
  }
  throw Failure(ExitCode::usage, what + " \"" + text + "\" is not LOW,HIGH with LOW below HIGH",
                hint);
}

}  // namespace

std::optional<core::signal::OpRange> parse_op_range(const std::string& text) {
  return parse_range(text, "op range", "e.g. --op-range 4,20 for milliamperes");
}

std::optional<core::signal::OpRange> parse_pv_range(const std::string& text) {
  return parse_range(text, "pv range", "e.g. --pv-range 0,250 for 0 to 250 m3/h");
}

}  // namespace loopscope::daemon
