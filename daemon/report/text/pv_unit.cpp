#include "daemon/report/text/pv_unit.hpp"

#include <algorithm>
#include <array>

namespace loopscope::daemon {
namespace {

/// What stands for a unit, and what the known one is written with.
struct Phrase {
  std::string_view text, before, behind;
};

/// The schema's list of figures writes "pv units".
constexpr std::array kPhrases{Phrase{"units of pv", "", ""}, Phrase{"unit of pv", "", ""},
                              Phrase{"pv units", "", ""}, Phrase{" pv per %", " ", " per %"}};

}  // namespace

std::string in_pv_unit(std::string_view text, const std::string& pv_unit) {
  std::string written;
  while (!text.empty()) {
    const auto* const phrase = std::ranges::find_if(
        kPhrases, [&](const Phrase& one) { return text.starts_with(one.text); });
    if (phrase == kPhrases.end()) {
      written += text.front();
      text.remove_prefix(1);
      continue;
    }
    if (!pv_unit.empty())
      written.append(phrase->before).append(pv_unit).append(phrase->behind);
    else
      written += phrase->text == "pv units" ? "units of pv" : phrase->text;
    text.remove_prefix(phrase->text.size());
  }
  return written;
}

}  // namespace loopscope::daemon
