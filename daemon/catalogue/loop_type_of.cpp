#include "daemon/catalogue/loop_type_of.hpp"

#include <array>
#include <cstddef>
#include <utility>

#include "daemon/catalogue/instrument_name.hpp"
#include "daemon/text/ascii.hpp"

namespace loopscope::daemon {
namespace {

constexpr std::array kMeasured{
    std::pair{'F', "flow"},     std::pair{'L', "level"},    std::pair{'T', "temperature"},
    std::pair{'P', "pressure"}, std::pair{'A', "analysis"},
};

/// Of a controller's letters; empty = they are none, or say no type.
std::string type_of_letters(std::string_view letters) {
  const auto found = instrument_letters(letters);
  if (!found || found->kind != InstrumentKind::controller) return {};
  for (const auto& [letter, type] : kMeasured) {
    if (found->measured.front() == letter) return type;
  }
  return {};
}

}  // namespace

std::string loop_type_of(std::string_view name) {
  std::string found;
  for (std::size_t begin = 0; begin < name.size();) {
    std::size_t end = begin;
    while (end < name.size() && is_ascii_letter(name[end])) ++end;
    if (std::string type = type_of_letters(name.substr(begin, end - begin)); !type.empty())
      found = std::move(type);
    begin = end == begin ? end + 1 : end;
  }
  return found;
}

}  // namespace loopscope::daemon
