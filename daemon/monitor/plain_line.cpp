#include "daemon/monitor/plain_line.hpp"

#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::string_view kCut = "...";

bool is_control(char byte) {
  constexpr unsigned char kDelete = 0x7f;
  const auto code = static_cast<unsigned char>(byte);
  return code < ' ' || code == kDelete;
}

bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

}  // namespace

std::string plain_line(std::string_view text, std::size_t most_bytes) {
  std::string line = storage::make_storable(text);
  for (char& byte : line) {
    if (is_control(byte)) byte = ' ';
  }
  if (line.size() <= most_bytes) return line;
  std::size_t end = most_bytes - kCut.size();
  while (end > 0 && continues_character(line[end])) --end;
  return line.substr(0, end).append(kCut);
}

}  // namespace loopscope::daemon
