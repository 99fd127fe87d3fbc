#include "daemon/text/cells.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace loopscope::daemon {
namespace {

using core::signal::ControlMode;

constexpr std::array kShortModes{
    std::pair{std::string_view{"m"}, ControlMode::manual},
    std::pair{std::string_view{"0"}, ControlMode::manual},
    std::pair{std::string_view{"a"}, ControlMode::automatic},
    std::pair{std::string_view{"1"}, ControlMode::automatic},
    std::pair{std::string_view{"c"}, ControlMode::cascade},
    std::pair{std::string_view{"2"}, ControlMode::cascade},
};

/// OPC DA: the two top bits of the low byte say good, uncertain or bad.
constexpr unsigned kOpcMajorMask = 0xC0;
constexpr unsigned kOpcGood = 0xC0;

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

bool same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

std::optional<double> parse_number(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.empty()) return core::signal::kMissing;
  if (cell.front() == '+') cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  const bool finite = error == std::errc{} && std::isfinite(value);
  return finite ? value : core::signal::kMissing;
}

std::optional<double> parse_number(std::string_view cell, char decimal_sign) {
  const std::size_t comma = cell.find(',');
  if (decimal_sign == '.' || comma == std::string_view::npos) {
    const bool foreign = decimal_sign != '.' && cell.find('.') != std::string_view::npos;
    return foreign ? std::nullopt : parse_number(cell);
  }
  if (cell.find('.') != std::string_view::npos) return std::nullopt;
  std::string text(cell);
  text[comma] = '.';
  return parse_number(text);
}

ControlMode parse_mode(std::string_view cell) {
  const auto mode_in = [&](const auto& words) -> std::optional<ControlMode> {
    for (const auto& [word, mode] : words) {
      if (same_word(trimmed(cell), word)) return mode;
    }
    return std::nullopt;
  };
  return mode_in(kModeWords).value_or(mode_in(kShortModes).value_or(ControlMode::unknown));
}

bool is_good_quality(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.empty() || same_word(cell, "good")) return true;
  unsigned code = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), code);
  return error == std::errc{} && end == cell.data() + cell.size() &&
         (code & kOpcMajorMask) == kOpcGood;
}

}  // namespace loopscope::daemon
