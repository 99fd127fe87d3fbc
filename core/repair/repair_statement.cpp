#include "core/repair/repair_statement.hpp"

#include <cmath>
#include <optional>

#include "core/text/counted.hpp"
#include "core/text/phrases.hpp"

namespace loopscope::core::repair {
namespace {

/// A verdict as something that stands or is gone.
std::string fault(std::string_view code) {
  if (code == "unexplained") return "a fault without a known cause";
  if (code == "nonlinear_unexplained") return "a nonlinearity without a known cause";
  return text::code_words(code);
}

std::string ratio(double value) {
  return text::fixed(value, 2);
}

std::string of_windows(std::size_t some, std::size_t all) {
  return std::to_string(some) + " of " + text::counted(all, "window", "windows");
}

std::string from_to(const FigureChange& figure) {
  return "went from " + text::display_number(figure.before->value) + " to " +
         text::display_number(figure.after->value);
}

std::string spread_text(const FigureChange* spread) {
  if (spread == nullptr || !spread->change)
    return "the error is not known on both sides of the work.";
  return "the error's standard deviation " + from_to(*spread) + " (x " +
         ratio(spread->change->value) + ", 90 % interval " + ratio(spread->change->low) + " to " +
         ratio(spread->change->high) + ").";
}

std::string capital(std::string_view word) {
  std::string text(word);
  text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

class Sentence {
 public:
  Sentence(const RepairWindows& windows, const RepairJudgement& judgement,
           const StatementFigures& figures)
      : windows_(windows), judgement_(judgement), figures_(figures) {
    if (judgement.fault_before)
      was_ = fault(judgement.fault_before->code);
    else if (!figures.suspected.empty())
      was_ = fault(figures.suspected);
  }

  [[nodiscard]] std::string text() const {
    if (windows_.before.empty())
      return "Cannot be compared: no usable window of the loop from before this work, and after "
             "any earlier work, is known.";
    if (windows_.after.empty()) return not_yet();
    return what_came_of_it() + spread_text(figures_.spread) + what_is_left() + what_is_back();
  }

 private:
  [[nodiscard]] std::string not_yet() const {
    if (windows_.refused.empty())
      return "Not judged yet: no window lies wholly after the work and before the next.";
    return "Not judged yet: the data after the work cannot be used: " + windows_.refused + ".";
  }

  /// Up to the words behind which the error stands.
  [[nodiscard]] std::string what_came_of_it() const {
    std::string start = capital(name(*judgement_.outcome)) + ": ";
    const bool gone = judgement_.fault_before && !judgement_.fault_after;
    if (judgement_.outcome == Outcome::fixed) return start + was_and(stood()) + gone_words() + "; ";
    if (judgement_.fault_after) return start + is_now() + " " + change_of_fault();
    if (judgement_.outcome == Outcome::worse && gone)
      return start + was_and(stood()) + gone_words() + ", but ";
    if (judgement_.outcome != Outcome::unchanged) return start;
    return start + "no fault stands" + (was_.empty() ? "" : ", before " + before_words()) + "; ";
  }

  [[nodiscard]] std::string was_and(const std::string& stood) const {
    return was_ + ", which " + stood + " before, ";
  }

  /// Gone, or no longer what most windows say.
  [[nodiscard]] std::string gone_words() const {
    if (!judgement_.fault_before) return "is gone";
    const std::size_t naming =
        windows_naming(windows_.after, judgement_.fault_before->family, windows_.min_confidence);
    if (naming == 0) return "is gone";
    return "no longer stands, though " + of_windows(naming, judgement_.windows_after) +
           (naming == 1 ? " after still names it" : " after still name it");
  }

  /// "it was tight tuning", "valve stiction was suspected".
  [[nodiscard]] std::string before_words() const {
    return judgement_.fault_before ? "it was " + was_ : was_ + " was suspected";
  }

  /// "valve stiction (2 of 2 windows)".
  [[nodiscard]] std::string is_now() const {
    return fault(judgement_.fault_after->code) + " (" +
           of_windows(judgement_.fault_after->windows, judgement_.windows_after) + ")";
  }

  [[nodiscard]] std::string stood() const {
    if (!judgement_.fault_before) return "was suspected";
    return "stood in " + of_windows(judgement_.fault_before->windows, judgement_.windows_before);
  }

  [[nodiscard]] std::string change_of_fault() const {
    const auto& was = judgement_.fault_before;
    const Outcome outcome = *judgement_.outcome;
    if (!was || was->family != judgement_.fault_after->family)
      return std::string(outcome == Outcome::worse && was_.empty() ? "is new" : "stands") +
             (was_.empty() ? ", before there was no fault; " : ", before " + before_words() + "; ");
    const std::string size = figures_.size == nullptr
                                 ? ""
                                 : "its " + text::code_words(figures_.size->kind->name) + " " +
                                       from_to(*figures_.size) + "; ";
    if (outcome == Outcome::improved) return "is left, but less; " + size;
    if (outcome == Outcome::worse) return "still stands, and more; " + size;
    return "stands as before; " + size;
  }

  [[nodiscard]] std::string what_is_left() const {
    if (judgement_.outcome != Outcome::fixed || !judgement_.fault_after) return "";
    return " What is left: " + is_now() + ".";
  }

  /// The comparison ends after six windows; a fault may come back later.
  [[nodiscard]] std::string what_is_back() const {
    if (judgement_.outcome != Outcome::fixed || !judgement_.fault_before || !windows_.newest ||
        windows_.newest->family != judgement_.fault_before->family ||
        windows_.newest->confidence < windows_.min_confidence)
      return "";
    return " It is back in the newest window, of " + windows_.newest->slot_end + " UTC.";
  }

  const RepairWindows& windows_;
  const RepairJudgement& judgement_;
  const StatementFigures& figures_;
  std::string was_;  ///< the fault before, in words; empty = none stood or was suspected
};

}  // namespace

std::string repair_statement(const RepairWindows& windows, const RepairJudgement& judgement,
                             const StatementFigures& figures) {
  return Sentence(windows, judgement, figures).text();
}

}  // namespace loopscope::core::repair
