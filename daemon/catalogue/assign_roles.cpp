#include "daemon/catalogue/assign_roles.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "daemon/catalogue/entry_fields.hpp"

namespace loopscope::daemon {
namespace {

using storage::CatalogueEntry;

/// One loop while its tags are given their roles by the words of one convention.
class Assigner {
 public:
  Assigner(std::span<const TagCandidate> candidates, const NamingConvention& convention)
      : candidates_(candidates), convention_(convention) {
    result_.entry.name = candidates.front().loop;
    result_.convention = &convention;
  }

  RoleAssignment assign() {
    // Words of one role first: a shared word takes what they leave.
    for (const TagRole& role : kTagRoles) fill(role, of_role(role, false));
    for (const TagRole& role : kTagRoles) {
      if (!tag_of(role).empty()) continue;
      fill(role, of_role(role, true));
      if (!tag_of(role).empty()) result_.by_shared_word = true;
    }
    look_at_shapes();
    return std::move(result_);
  }

 private:
  using Ranked = std::vector<std::pair<std::size_t, const TagCandidate*>>;

  [[nodiscard]] std::string& tag_of(const TagRole& role) { return result_.entry.*role.tag; }

  [[nodiscard]] bool is_shared(const std::string& word) const {
    return std::ranges::count_if(kTagRoles, [&](const TagRole& role) {
             return convention_.rank(role.name, word).has_value();
           }) > 1;
  }

  [[nodiscard]] bool is_taken(const std::string& tag) const {
    return std::ranges::any_of(kTagRoles,
                               [&](const TagRole& role) { return result_.entry.*role.tag == tag; });
  }

  [[nodiscard]] Ranked of_role(const TagRole& role, bool shared) const {
    Ranked ranked;
    for (const TagCandidate& candidate : candidates_) {
      const auto rank = convention_.rank(role.name, candidate.word);
      if (!rank || is_shared(candidate.word) != shared || is_taken(candidate.tag)) continue;
      ranked.emplace_back(*rank, &candidate);
    }
    std::ranges::stable_sort(ranked, {}, [](const auto& one) { return one.first; });
    return ranked;
  }

  [[nodiscard]] std::size_t of_shape(const TagCandidate& candidate) const {
    return static_cast<std::size_t>(
        std::ranges::count(candidates_, candidate.shape, &TagCandidate::shape));
  }

  /// The preferred word decides; between words of one rank, whether one is named as most of the
  /// loop's other tags are; else nothing does.
  [[nodiscard]] const TagCandidate* preferred(const Ranked& ranked) const {
    std::vector<const TagCandidate*> first;
    for (const auto& [rank, candidate] : ranked)
      if (rank == ranked.front().first) first.push_back(candidate);
    if (first.size() == 1) return first.front();
    if (std::ranges::any_of(
            first, [&](const TagCandidate* one) { return one->word != first.front()->word; }))
      return nullptr;
    std::ranges::stable_sort(first, std::ranges::greater{},
                             [&](const TagCandidate* one) { return of_shape(*one); });
    return of_shape(*first[0]) > of_shape(*first[1]) ? first[0] : nullptr;
  }

  void fill(const TagRole& role, const Ranked& ranked) {
    if (ranked.empty()) return;
    const TagCandidate* chosen = preferred(ranked);
    if (chosen != nullptr) {
      tag_of(role) = chosen->tag;
      if (role.name == "pv") result_.entry.name = chosen->loop;
    }
    if (ranked.size() == 1) return;
    AmbiguousRole& ambiguous = result_.ambiguous.emplace_back();
    ambiguous.role = role.name;
    ambiguous.taken = tag_of(role);
    for (const auto& [rank, candidate] : ranked) ambiguous.tags.push_back(candidate->tag);
  }

  void look_at_shapes() {
    std::set<std::string> shapes;
    for (const TagCandidate& candidate : candidates_) {
      const CatalogueEntry& entry = result_.entry;
      if (candidate.tag != entry.sp_tag && candidate.tag != entry.pv_tag &&
          candidate.tag != entry.op_tag)
        continue;
      shapes.insert(candidate.shape);
      result_.glued = result_.glued || candidate.glued;
    }
    result_.one_shape = shapes.size() <= 1;
    for (AmbiguousRole& ambiguous : result_.ambiguous) ambiguous.loop = result_.entry.name;
  }

  std::span<const TagCandidate> candidates_;
  const NamingConvention& convention_;
  RoleAssignment result_;
};

/// What a convention makes of a loop, the more the better: signals, roles, roles with candidates
/// that it cannot tell apart.
std::array<std::size_t, 3> worth(const RoleAssignment& assignment) {
  const auto filled = std::ranges::count_if(
      kTagRoles, [&](const TagRole& role) { return !(assignment.entry.*role.tag).empty(); });
  const auto open =
      std::ranges::count_if(assignment.ambiguous, &std::string::empty, &AmbiguousRole::taken);
  return {assignment.signals(), static_cast<std::size_t>(filled), static_cast<std::size_t>(open)};
}

/// No other convention could make more of it.
bool is_all(const RoleAssignment& assignment, std::span<const TagCandidate> candidates) {
  return assignment.signals() == 3 && worth(assignment)[1] == candidates.size();
}

}  // namespace

std::size_t RoleAssignment::signals() const {
  return static_cast<std::size_t>(!entry.sp_tag.empty()) +
         static_cast<std::size_t>(!entry.pv_tag.empty()) +
         static_cast<std::size_t>(!entry.op_tag.empty());
}

RoleAssignment assign_roles(std::span<const TagCandidate> candidates,
                            std::span<const NamingConvention> conventions) {
  std::optional<RoleAssignment> best;
  for (const NamingConvention& convention : conventions) {
    RoleAssignment assignment = Assigner(candidates, convention).assign();
    if (!best || worth(assignment) > worth(*best)) best = std::move(assignment);
    if (is_all(*best, candidates)) break;
  }
  return std::move(*best);
}

}  // namespace loopscope::daemon
