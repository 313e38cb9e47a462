// Feet of a plan rebuilt from chain and arc length, and compared with where the plan says they stand.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gaits/verifier_checks.hpp"

namespace surefoot::gaits::bare {

using terrain::Foothold;
using terrain::Segment;

namespace {

/// What positions and arc lengths may differ by for being doubles.
double rounding(const Point& position, double s) {
  return 8 * std::numeric_limits<double>::epsilon() * std::max(position.cwiseAbs().maxCoeff(), std::abs(s));
}

}  // namespace

std::optional<Foot> Checks::rebuild(const std::string& place, int leg, const Foothold& stated) {
  // Segments lie in the order of chains and arc lengths: the last one that begins before the foot.
  const std::vector<Segment>& segments = scene_.terrain.segments();
  const auto after = std::partition_point(segments.begin(), segments.end(), [&stated](const Segment& segment) {
    return segment.chain < stated.chain || (segment.chain == stated.chain && segment.s_begin < stated.s);
  });
  const auto end = std::partition_point(after, segments.end(),
                                        [&stated](const Segment& segment) { return segment.chain <= stated.chain; });
  const bool chain_exists = end != segments.begin() && std::prev(end)->chain == stated.chain;
  const double chain_length = chain_exists ? std::prev(end)->s_begin + std::prev(end)->length : 0;
  if (after != segments.begin() && std::prev(after)->chain == stated.chain &&
      stated.s < std::prev(after)->s_begin + std::prev(after)->length) {
    const Segment& segment = *std::prev(after);
    const double part = (stated.s - segment.s_begin) / segment.length;
    const Foot foot{stated.s, &segment, segment.a + part * (segment.b - segment.a)};
    const double allowed = slack_ + rounding(foot.position, segment.s_begin + segment.length);
    if (!((stated.position - foot.position).cwiseAbs().maxCoeff() <= allowed)) {
      lose(place, leg, stated, "is said to stand at {}, but s = {} of chain {} is at {}", show(stated.position),
           stated.s, stated.chain, show(foot.position));
      return std::nullopt;
    }
    if (!segment.surface.foothold) {
      note(Rule::foothold, place, "foot {} stands on segment {} of chain {}, where no foot may stand", leg + 1,
           segment.index, segment.chain);
    }
    standing_.push_back({place, leg, &stated, segment.index});
    return foot;
  }
  if (!chain_exists) {
    lose(place, leg, stated, "stands on chain {}, which does not exist", stated.chain);
  } else if (stated.s >= 0 && stated.s <= chain_length) {
    lose(place, leg, stated, "stands on a vertex of chain {} (s = {})", stated.chain, stated.s);
  } else {
    lose(place, leg, stated, "stands at s = {}, outside chain {} of length {:.6g} m", stated.s, stated.chain,
         chain_length);
  }
  return std::nullopt;
}

std::optional<Checks::Found> Checks::ground_at(const Foothold& stated) const {
  if (!stated.position.allFinite()) return std::nullopt;
  std::optional<Found> found;
  const double near = slack_ + rounding(stated.position, 0);
  for (const Segment* segment : strips_.near({stated.position}, near)) {
    if (distances_along(stated.position, segment->a, segment->b).least > near) continue;
    const Point along = (segment->b - segment->a) / segment->length;
    const Found here{segment->chain, segment->s_begin + along.dot(stated.position - segment->a)};
    if (!found || (found->chain != stated.chain && here.chain == stated.chain)) found = here;
  }
  return found;
}

std::string Checks::cause_of(const Foothold& stated, const Found& found) {
  if (found.chain != stated.chain)
    return fmt::format("feet of chain {} lie on chain {} now", stated.chain, found.chain);
  const double shift = found.s - stated.s;
  return fmt::format(
      "chain {} begins {:.6g} m {} than when the plan was made, or is that much {} before these feet (s counts from "
      "its first vertex), unless the plan was edited",
      stated.chain, std::abs(shift), shift > 0 ? "earlier" : "later", shift > 0 ? "longer" : "shorter");
}

// Lost feet of a chain that lie on the ground after all, by one and the same way further along: vertices were added or
// taken away before them, or another chain was. One fault says it of all of them.
void Checks::tell_lost_feet() {
  struct Moved {
    const LostFoot* first;
    Found found;  // where the first one lies
    std::set<double> arc_lengths;
  };
  constexpr std::size_t most_groups = 64;  // a plan of feet that are all over the place is told foot by foot
  std::vector<Moved> moved;
  std::vector<std::optional<std::size_t>> group_of;  // of each lost foot
  for (const LostFoot& lost : lost_) {
    const std::optional<Found> here = ground_at(*lost.stated);
    const Foothold& mine = *lost.stated;
    const auto allowed = [&](double s) { return 4 * slack_ + rounding(mine.position, std::max(std::abs(mine.s), s)); };
    const auto together = [&](const Moved& other) {
      const Foothold& first = *other.first->stated;
      return first.chain == mine.chain && other.found.chain == here->chain &&
             std::abs((here->s - mine.s) - (other.found.s - first.s)) <= allowed(std::abs(other.found.s));
    };
    // Found where it is stated: a vertex.
    const bool stays = here && here->chain == mine.chain && std::abs(here->s - mine.s) <= allowed(here->s);
    auto group = here && !stays ? std::find_if(moved.begin(), moved.end(), together) : moved.end();
    if (!here || stays || (group == moved.end() && moved.size() == most_groups)) {
      group_of.emplace_back();
      continue;
    }
    if (group == moved.end()) group = moved.insert(moved.end(), {&lost, *here, {}});
    group->arc_lengths.insert(lost.stated->s);
    group_of.emplace_back(static_cast<std::size_t>(group - moved.begin()));
  }
  const auto told_together = [](const Moved& group) { return group.arc_lengths.size() > 1; };
  for (const Moved& group : moved) {
    if (!told_together(group)) continue;
    const Foothold& first = *group.first->stated;
    note(Rule::foothold, "plan",
         "{}: {} footholds lie on the ground where the plan says, but not at the s it says; foot {} of {} at {}, for "
         "one, is at s = {:.6g} of chain {}, not s = {:.6g} of chain {}",
         cause_of(first, group.found), group.arc_lengths.size(), group.first->leg + 1, group.first->place,
         show(first.position), group.found.s, group.found.chain, first.s, first.chain);
  }
  for (std::size_t i = 0; i < lost_.size(); ++i)
    if (!group_of[i] || !told_together(moved[*group_of[i]]))
      note(Rule::foothold, lost_[i].place, "{}", lost_[i].message);
}

/// Whether the segments stated of the feet on a chain are what vertices that came or went would make of them: further
/// along, wrong by as much or more.
bool Checks::vertices_explain(std::vector<const StandingFoot*> feet) {
  std::sort(feet.begin(), feet.end(), [](const auto* l, const auto* r) { return l->stated->s < r->stated->s; });
  const auto breaks = [](const StandingFoot* l, const StandingFoot* r) {
    const std::int64_t before = l->too_high(), after = r->too_high();
    return l->stated->s == r->stated->s
               ? before != after
               : std::min({before, after, after - before}) < 0 && std::max({before, after, after - before}) > 0;
  };
  return std::adjacent_find(feet.begin(), feet.end(), breaks) == feet.end();
}

void Checks::tell_renumbered_feet() {
  std::map<int, std::vector<const StandingFoot*>> chains;
  for (const StandingFoot& foot : standing_) chains[foot.stated->chain].push_back(&foot);
  for (auto& [chain, feet] : chains) {
    const bool explained = vertices_explain(feet);
    std::erase_if(feet, [](const StandingFoot* foot) { return foot->too_high() == 0; });
    if (feet.empty()) continue;
    const auto same = [s = feet.front()->stated->s](const StandingFoot* foot) { return foot->stated->s == s; };
    const bool one_foothold = std::all_of(feet.begin(), feet.end(), same);
    for (const StandingFoot* foot : feet) {
      if (explained && !one_foothold) {  // the same words at every place
        note(Rule::foothold, foot->place,
             "the segment stated of a foot on chain {} is {} too {} for its position and arc length, which agree: have "
             "vertices before it come or gone?",
             chain, std::abs(foot->too_high()), foot->too_high() > 0 ? "high" : "low");
      } else {
        note(Rule::foothold, foot->place,
             "foot {} is said to stand on segment {}, but its position and s lie on segment {} of chain {}{}",
             foot->leg + 1, foot->stated->segment, foot->segment, chain,
             explained ? ": have vertices before it come or gone?" : "");
      }
    }
  }
}

}  // namespace surefoot::gaits::bare
