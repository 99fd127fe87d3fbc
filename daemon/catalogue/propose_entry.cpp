#include "daemon/catalogue/propose_entry.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "core/signal/op_range.hpp"
#include "core/signal/spread.hpp"
#include "daemon/catalogue/loop_type_of.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::KnownRange;
using core::signal::OpRange;
using core::signal::RangeSource;
using storage::CatalogueEntry;

/// What speaks against filling it in; empty = nothing. An output that stays within 4 to 20 may be a
/// current or a percentage, one near 0 a share or the percentage of a valve that is shut, and
/// counts have many full scales.
std::string ambiguity(const core::signal::OpValues& values, const OpRange& range) {
  constexpr double kShut = 0.2;
  if (range.high == 100.0 && values.low >= 4.0 && values.high <= 20.0)
    return "0 to 100 (%) or 4 to 20 (mA)?";
  if (range.high == 1.0 && values.high < kShut) return "0 to 1, or the percentage of a shut valve?";
  return range.high > 100.0 ? core::signal::range_text(range) + " (counts)?" : "";
}

std::string fields_of(const OpRange& range) {
  return fmt::format("op_low={} op_high={}", range.low, range.high);
}

void propose_op(const CatalogueEntry& entry, const core::signal::Samples& op,
                std::vector<Proposal>& proposals) {
  const auto values = core::signal::summarise_op(op);
  if (!values || !(values->low < values->high)) return;
  const KnownRange found = core::signal::find_op_range(op, entry.op_range);
  const std::string seen =
      fmt::format("op is {:.6g} to {:.6g} in {} values", values->low, values->high, op.size());
  if (found.source == RangeSource::set) return;
  if (!found.range) {
    proposals.push_back({entry.name, "", seen + ": no usual range; set op_low and op_high"});
    return;
  }
  const OpRange range = *found.range;
  if (const std::string doubt = ambiguity(*values, range); !doubt.empty() && !entry.op_range) {
    proposals.push_back({entry.name, "", seen + ": " + doubt});
    return;
  }
  const std::string reason = found.doubt.empty()
                                 ? seen + ", never outside " + core::signal::range_text(range)
                                 : found.doubt;
  // What a person has set only a person replaces.
  if (entry.op_range) {
    proposals.push_back({entry.name, "", reason + ": " + fields_of(range) + "?"});
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

/// History cannot know the transmitter's range: it is a question.
void ask_for_pv(const CatalogueEntry& entry, const core::signal::Samples& pv,
                std::vector<Proposal>& proposals) {
  const auto spread = core::signal::measure_spread(pv);
  if (entry.pv_range || !spread || !(spread->high > 0.0)) return;
  const double low = spread->low < 0.0 ? -round_above(-spread->low) : 0.0;
  proposals.push_back(
      {entry.name, "",
       fmt::format("pv is {:.6g} to {:.6g} in {} values: pv_low={} pv_high={}?", spread->low,
                   spread->high, pv.size(), low, round_above(spread->high))});
}

void propose_type(const CatalogueEntry& entry, std::vector<Proposal>& proposals) {
  if (!entry.loop_type.empty()) return;
  std::string type = loop_type_of(entry.name);
  if (type.empty()) return;
  const std::string fields = "loop_type=" + type;
  proposals.push_back(
      {entry.name, fields, "the letters of its name (ISA 5.1)",
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
