#include "daemon/catalogue/match_transmitters.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "daemon/catalogue/instrument_name.hpp"

namespace loopscope::daemon {
namespace {

/// The name of a whole instrument; nullopt when more follows in the path, or nothing is one.
std::optional<InstrumentName> whole_name(const std::string& path) {
  auto name = instrument_name(path);
  if (name && !name->ends_path) name.reset();
  return name;
}

std::string key_of(const InstrumentName& name) {
  return name.letters.measured + ' ' + name.number;
}

}  // namespace

void Transmitters::add(const std::string& path, const std::string& tag) {
  const auto name = whole_name(path);
  if (!name) return;
  const InstrumentKind kind = name->letters.kind;
  if (kind != InstrumentKind::transmitter && kind != InstrumentKind::indicator) return;
  measurements_[key_of(*name)].push_back(
      {name->place, name->suffix, tag, kind == InstrumentKind::transmitter});
}

std::vector<const Transmitters::Measurement*> Transmitters::fitting(const std::string& path,
                                                                    bool exactly) const {
  std::vector<const Measurement*> found;
  const auto controller = whole_name(path);
  if (!controller || controller->letters.kind != InstrumentKind::controller) return found;
  const auto known = measurements_.find(key_of(*controller));
  if (known == measurements_.end()) return found;
  for (const Measurement& one : known->second) {
    const bool same = one.place == controller->place && one.suffix == controller->suffix;
    if (same || !exactly) found.push_back(&one);
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &Measurement::transmitter);
  return found;
}

/// The one that it is: alone, or the only transmitter beside indicators.
const Transmitters::Measurement* Transmitters::certain(
    const std::vector<const Measurement*>& exact) {
  if (exact.empty()) return nullptr;
  if (exact.size() > 1 && exact[0]->transmitter == exact[1]->transmitter) return nullptr;
  return exact.front();
}

std::vector<std::string> Transmitters::give(std::span<const BlindController> controllers) const {
  // A number that every unit has says nothing.
  constexpr std::size_t kMostCandidates = 6;
  std::map<std::string, std::vector<RoleAssignment*>> wanted;  // by the one tag that fits
  for (const auto& [path, roles] : controllers) {
    const auto exact = fitting(path, true);
    const Measurement* one = certain(exact);
    if (one != nullptr) wanted[one->tag].push_back(roles);
    const auto candidates = exact.empty() ? fitting(path, false) : exact;
    if (candidates.size() > kMostCandidates || candidates.size() < (one != nullptr ? 2 : 1))
      continue;
    AmbiguousRole role{roles->entry.name, "pv", {}, one != nullptr ? one->tag : ""};
    for (const Measurement* candidate : candidates) role.tags.push_back(candidate->tag);
    roles->ambiguous.push_back(std::move(role));
  }
  return give_wanted(wanted);
}

std::vector<std::string> Transmitters::give_wanted(
    const std::map<std::string, std::vector<RoleAssignment*>>& wanted) {
  std::vector<std::string> given;
  for (const auto& [tag, loops] : wanted) {
    if (loops.size() == 1) {
      loops.front()->entry.pv_tag = tag;
      given.push_back(tag);
      continue;
    }
    for (RoleAssignment* loop : loops) {
      std::erase_if(loop->ambiguous, [](const AmbiguousRole& role) { return role.role == "pv"; });
      loop->ambiguous.push_back({loop->entry.name, "pv", {tag}, ""});
    }
  }
  return given;
}

}  // namespace loopscope::daemon
