#include "core/diagnosis/words.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace loopscope::core::diagnosis {
namespace {

struct Words {
  VerdictCode code;
  std::string_view summary;
  std::string_view action;
};

constexpr std::array kWords{
    Words{VerdictCode::healthy, "No sustained oscillation and no nonlinearity were found.",
          "Nothing to do."},
    Words{
        VerdictCode::valve_stiction, "The control valve sticks.",
        "Check in the field: put the controller in manual, step the output by 0.5 % at a time and "
        "watch when the stem moves; then packing, actuator and positioner."},
    Words{VerdictCode::valve_deadband, "The control valve has dead band.",
          "Check linkage and positioner for play; measure the travel in both directions."},
    Words{
        VerdictCode::valve_saturation, "The controller output is at its limit.",
        "Check whether the valve is too small, the bypass open or the setpoint out of reach; tune "
        "only after that."},
    Words{VerdictCode::valve_characteristic, "The valve's characteristic is curved.",
          "Check trim and seat for wear or corrosion and compare with the data sheet."},
    Words{VerdictCode::valve_oversized,
          "Tiny moves of the valve swing the process variable: the valve is too large.",
          "Compare the valve's size with the usual flow; consider a smaller trim or valve."},
    Words{VerdictCode::process_nonlinearity,
          "The process itself is nonlinear; the valve follows its signal.",
          "Consider gain scheduling or a linearising function; check the operating point."},
    Words{VerdictCode::external_disturbance, "An oscillation reaches the loop from outside.",
          "Look for another loop with the same period before this one is touched."},
    Words{VerdictCode::process_change, "The process has changed within the window.",
          "Check what was changed at that time."},
    Words{VerdictCode::sensor_fault, "The measurement is not trustworthy.",
          "Check transmitter, impulse lines and the archive's settings for this tag."},
    Words{VerdictCode::tight_tuning, "The loop oscillates by itself: the controller is too tight.",
          "Lower the controller gain or slow the integral action; check that no valve fault hides "
          "behind it."},
    Words{VerdictCode::sluggish_tuning, "The loop corrects disturbances slowly.",
          "Raise the controller gain or speed up the integral action in small steps."},
    Words{VerdictCode::nonlinear_unexplained,
          "The loop is nonlinear; its data alone do not show where.",
          "Record the valve position (mv) or do a stroke test, then analyse again."},
    Words{VerdictCode::unexplained, "The loop performs poorly for a reason that was not found.",
          "Look at the trends of setpoint, process variable and controller output."},
    Words{VerdictCode::insufficient_data, "The data cannot be judged.",
          "Mend what the reason names: the recording of the tags, or the controller's mode."},
};

const Words& words_of(VerdictCode code) {
  for (const Words& words : kWords) {
    if (words.code == code) return words;
  }
  return kWords.back();
}

}  // namespace

std::string summary_of(VerdictCode code) {
  return std::string(words_of(code).summary);
}

std::string action_for(VerdictCode code) {
  return std::string(words_of(code).action);
}

std::string tuning_waits() {
  return " Leave the tuning alone until that is mended.";
}

std::string p_text(double p) {
  constexpr double kLeast = 1e-12;
  constexpr int kDigits = 2;
  if (p < kLeast) return "< 1e-12";
  std::array<char, 32> text{};
  const auto result =
      std::to_chars(text.data(), text.data() + text.size(), p, std::chars_format::general, kDigits);
  return {text.data(), result.ptr};
}

std::string p_equals(double p) {
  const std::string text = p_text(p);
  return (text.front() == '<' ? "p " : "p = ") + text;
}

}  // namespace loopscope::core::diagnosis
