#include "daemon/catalogue/propose_entry.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "core/signal/op_range.hpp"
#include "core/signal/order/spread.hpp"
#include "core/text/counted.hpp"
#include "daemon/catalogue/loop_type_of.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::KnownRange;
using core::signal::OpRange;
using core::signal::RangeSource;
using storage::CatalogueEntry;

/// Ranges of the signals that go to valves, beside percent.
struct SignalRange {
  double low, high;
  const char* text;
};
constexpr std::array kSignalRanges{SignalRange{4.0, 20.0, "4 to 20 (mA)"},
                                   SignalRange{3.0, 15.0, "3 to 15 (psi)"},
                                   SignalRange{1.0, 5.0, "1 to 5 (V)"}};

std::string range_answer(const char* of, double low, double high) {
  return fmt::format("--{0}-low={1} --{0}-high={2}", of, low, high);
}

std::string op_answer(const OpRange& range) {
  return range_answer("op", range.low, range.high);
}

struct Ambiguity {
  std::string question;  ///< empty = nothing speaks against filling it in
  std::vector<std::string> answers;
};

/// An output of a few percent may be any other signal as well, one near 0 a share or the percentage
/// of a valve that is shut, and counts have many full scales.
Ambiguity ambiguity(const core::signal::OpValues& values, const OpRange& range) {
  constexpr double kShut = 0.2;
  constexpr OpRange kPercent{0.0, 100.0};
  if (range.high == 100.0) {
    Ambiguity found{"0 to 100 (%)", {op_answer(range)}};
    for (const SignalRange& signal : kSignalRanges) {
      if (values.low < signal.low || values.high > signal.high) continue;
      found.question += std::string(" or ") + signal.text;
      found.answers.push_back(range_answer("op", signal.low, signal.high));
    }
    return found.answers.size() > 1 ? Ambiguity{found.question + "?", found.answers} : Ambiguity{};
  }
  if (range.high == 1.0 && values.high < kShut)
    return {"0 to 1, or the percentage of a shut valve?", {op_answer(range), op_answer(kPercent)}};
  if (range.high > 100.0)
    return {core::signal::range_text(range) + " (counts)?", {op_answer(range)}};
  return {};
}

std::string fields_of(const OpRange& range) {
  return fmt::format("op_low={} op_high={}", range.low, range.high);
}

Proposal question(const CatalogueEntry& entry, const std::string& text,
                  std::vector<std::string> answers) {
  return {entry.name, "", text, nullptr, std::move(answers)};
}

void propose_op(const CatalogueEntry& entry, const core::signal::Samples& op,
                std::vector<Proposal>& proposals) {
  const auto values = core::signal::summarise_op(op);
  if (!values || !(values->low < values->high)) return;
  const KnownRange found = core::signal::find_op_range(op, entry.op_range);
  const std::string seen = fmt::format("op is {:.6g} to {:.6g} in {}", values->low, values->high,
                                       core::text::counted(op.size(), "value", "values"));
  if (found.source == RangeSource::set) return;
  if (!found.range) {
    proposals.push_back(
        question(entry, seen + ": no usual range; which is it?", {"--op-low=LOW --op-high=HIGH"}));
    return;
  }
  const OpRange range = *found.range;
  const Ambiguity open = ambiguity(*values, range);
  if (!open.question.empty() && !entry.op_range) {
    proposals.push_back(question(entry, seen + ": " + open.question, open.answers));
    return;
  }
  const std::string reason = found.doubt.empty()
                                 ? seen + ", never outside " + core::signal::range_text(range)
                                 : found.doubt;
  // What a person has set only a person replaces.
  if (entry.op_range) {
    proposals.push_back(question(entry,
                                 reason + ": is its range " + core::signal::range_text(range) + "?",
                                 {op_answer(range)}));
    return;
  }
  proposals.push_back({entry.name, fields_of(range), reason,
                       [range](CatalogueEntry& changed) { changed.op_range = range; }});
}

/// The smallest 1, 2, 2.5 or 5 times a power of ten that is not below.
double round_above(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 2.5, 5.0}) {
    if (step * power >= value) return step * power;
  }
  return 10.0 * power;
}

/// Transmitters read a little beyond their range.
bool fits(const core::signal::Spread& pv, const OpRange& range) {
  constexpr double kBeyond = 0.05;
  const double margin = kBeyond * (range.high - range.low);
  return pv.low >= range.low - margin && pv.high <= range.high + margin;
}

/// History cannot know the transmitter's range, only that pv is outside of one: it is a question.
void ask_for_pv(const CatalogueEntry& entry, const core::signal::Samples& pv,
                std::vector<Proposal>& proposals) {
  const auto spread = core::signal::measure_spread(pv);
  if (!spread || (entry.pv_range && fits(*spread, *entry.pv_range))) return;
  if (!entry.pv_range && !(spread->high > 0.0)) return;
  std::string seen = fmt::format("pv is {:.6g} to {:.6g} in {}", spread->low, spread->high,
                                 core::text::counted(pv.size(), "value", "values"));
  if (entry.pv_range) seen += ", not within " + core::signal::range_text(*entry.pv_range);
  const double low = spread->low < 0.0 ? -round_above(-spread->low) : 0.0;
  const double high = spread->high > 0.0 ? round_above(spread->high) : 0.0;
  proposals.push_back(
      question(entry, fmt::format("{}: is its transmitter's range {} to {}?", seen, low, high),
               {range_answer("pv", low, high)}));
}

void propose_type(const CatalogueEntry& entry, std::vector<Proposal>& proposals) {
  if (!entry.loop_type.empty()) return;
  std::string type = loop_type_of(entry.name);
  if (type.empty()) return;
  const std::string fields = "loop_type=" + type;
  proposals.push_back(
      {entry.name, fields, "by the letters of its name, ISA 5.1",
       [type = std::move(type)](CatalogueEntry& changed) { changed.loop_type = type; }});
}

}  // namespace

std::vector<Proposal> propose(const CatalogueEntry& entry, const LoopValues& values) {
  std::vector<Proposal> proposals;
  propose_type(entry, proposals);
  propose_op(entry, values.op, proposals);
  ask_for_pv(entry, values.pv, proposals);
  return proposals;
}

void fill_in(std::span<const Proposal> proposals, CatalogueEntry& entry) {
  for (const Proposal& proposal : proposals) {
    if (proposal.apply) proposal.apply(entry);
  }
}

}  // namespace loopscope::daemon
