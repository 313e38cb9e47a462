// What `surefoot simulate` says of one run in words and in JSON.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gaits/motion_svg.hpp"
#include "gaits/text_table.hpp"
#include "planner/simulate_command.hpp"

namespace surefoot::planner {
namespace {

using Tree = nlohmann::ordered_json;
using stability::BodyState;
using stability::HybridBody;
using stability::HybridEvent;
using Kind = HybridEvent::Kind;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::collision: return "collision";
    case Kind::bouncing: return "bouncing";
    case Kind::clattering: return "clattering";
    case Kind::chattering: return "chattering";
    case Kind::dies_out: return "dies_out";
    case Kind::mode: return "mode";
    case Kind::sample: return "sample";
    case Kind::stops: return "stops";
    case Kind::lifts: return "lifts";
    case Kind::slips: return "slips";
    default: return "reaches";
  }
}

Tree list(const std::array<double, 2>& values, int count) {
  Tree tree = Tree::array();
  for (int i = 0; i < count; ++i) tree.push_back(values[static_cast<std::size_t>(i)]);
  return tree;
}

void put_state(Tree& tree, const BodyState& s, int contacts) {
  tree["q"] = {s.r.x(), s.r.y(), s.theta};
  tree["q_rate"] = {s.v.x(), s.v.y(), s.omega};
  tree["heights"] = list(s.h, contacts);
  tree["heights_rate"] = list(s.rate, contacts);
}

Tree event_tree(const HybridEvent& event, int contacts) {
  Tree tree;
  tree["t"] = event.time;
  tree["event"] = kind_name(event.kind);
  const bool both = event.kind == Kind::clattering || event.kind == Kind::chattering || event.kind == Kind::dies_out;
  if (!both && event.kind != Kind::mode && event.kind != Kind::sample) tree["contact"] = event.contact + 1;
  if (event.kind == Kind::collision) tree["speed"] = event.speed;
  if (event.kind == Kind::bouncing) tree["duration"] = event.duration;
  if (event.kind == Kind::mode) tree["mode"] = event.mode.name();
  if (event.ambiguous) tree["ambiguous"] = true;
  put_state(tree, event.state, contacts);
  return tree;
}

std::string ending(const HybridBody& body, const SimulateRecord& record) {
  const auto& run = record.run;
  switch (run.outcome) {
    case stability::HybridRun::Outcome::rest:
      return fmt::format("at rest after {:.9g} s, displaced by {:.3g} m and turned by {:.3g} rad", run.time,
                         body.excursion(run.state), run.state.theta);
    case stability::HybridRun::Outcome::left:
      return fmt::format("left its neighbourhood of {:.3g} m after {:.9g} s", record.neighbourhood, run.time);
    case stability::HybridRun::Outcome::inconsistent:
      return fmt::format("no contact mode is consistent after {:.9g} s: only an impact could resolve it", run.time);
    default:
      return fmt::format("undecided: still moving after {:.9g} s and {} collision{}", run.time, run.collisions,
                         run.collisions == 1 ? "" : "s");
  }
}

/// A line of the table: an event, or several collisions in a row.
struct Row {
  double time;
  std::string what;
  std::string same;  ///< equal in lines that tell of the same
  BodyState state;
};

std::vector<Row> rows_of(const SimulateRecord& record) {
  std::vector<Row> rows{{0, "start", "start", record.start}};
  const auto collides = [&](std::size_t k) {
    return k < record.events.size() && record.events[k].kind == Kind::collision;
  };
  for (std::size_t k = 0; k < record.events.size(); ++k) {
    if (record.events[k].kind == Kind::sample) continue;
    std::size_t run = 1;
    for (; collides(k) && collides(k + 1); ++k) ++run;
    const HybridEvent& last = record.events[k];
    const std::string what = run > 1 ? fmt::format("{} collisions", run) : gaits::words(last);
    rows.push_back({last.time, what, run > 1 ? "collisions" : what, last.state});
  }
  return rows;
}

/// Of a round of events that is repeated (a body that rocks from foot to foot) only the first is kept, then one line.
std::vector<Row> fold_rounds(const std::vector<Row>& rows) {
  constexpr std::size_t longest = 16, least_repeats = 2;
  std::vector<Row> folded;
  for (std::size_t k = 0; k < rows.size();) {
    std::size_t length = 1, repeats = 0;
    for (; length <= longest; ++length) {
      const auto same = [&](std::size_t i) { return i < rows.size() && rows[i].same == rows[i - length].same; };
      std::size_t end = k + length;
      while (same(end)) ++end;
      repeats = (end - k) / length - 1;
      if (repeats >= least_repeats) break;
    }
    if (repeats < least_repeats) {
      folded.push_back(rows[k++]);
      continue;
    }
    for (std::size_t i = k; i < k + length; ++i) folded.push_back(rows[i]);
    k += (repeats + 1) * length;
    const Row& last = rows[k - 1];
    const std::string what = length == 1 ? fmt::format("... {} times more", repeats)
                                         : fmt::format("... these {} lines {} times more", length, repeats);
    folded.push_back({last.time, what, what, last.state});
  }
  return folded;
}

}  // namespace

std::string simulation_to_json(const HybridBody& body, const SimulateRecord& record) {
  const auto& run = record.run;
  Tree tree;
  tree["surefoot"] = 1;
  tree["posture"] = record.title;
  tree["restitution"] = record.restitution;
  tree["linearised"] = body.linearised();
  tree["outcome"] = name(run.outcome);
  tree["time"] = run.time;
  put_state(tree, run.state, body.contacts());
  tree["feet"] = Tree::array();
  for (int i = 0; i < body.contacts(); ++i) {
    const Eigen::Vector2d foot = body.point(run.state, i);
    tree["feet"].push_back({foot.x(), foot.y()});
  }
  tree["displacement"] = body.excursion(run.state);
  tree["greatest_displacement"] = run.greatest_excursion;
  tree["collisions"] = run.collisions;
  tree["accumulations"] = run.accumulations;
  tree["ambiguous_modes"] = run.ambiguous;
  tree["events_omitted"] = record.omitted;
  std::string out = tree.dump(-1, ' ', false, Tree::error_handler_t::replace);
  out.pop_back();
  out += ",\"events\":[";
  bool first = true;
  for (const HybridEvent& event : record.events) {
    out += (first ? "\n " : ",\n ") + event_tree(event, body.contacts()).dump();
    first = false;
  }
  return out + "]}\n";
}

std::string simulation_to_text(const HybridBody& body, const SimulateRecord& record) {
  using gaits::TextTable;
  std::string out = fmt::format("{}, restitution {:.6g}{}: {}\n", record.title, record.restitution,
                                body.linearised() ? ", linearised" : "", ending(body, record));
  TextTable table({{"", "time [s]", TextTable::Align::right},
                   {"", "what happens", TextTable::Align::left},
                   {"", "h1 [m]", TextTable::Align::right},
                   {"", "h2 [m]", TextTable::Align::right},
                   {"", "theta [rad]", TextTable::Align::right}});
  constexpr std::size_t most_rows = 60;
  const std::vector<Row> rows = fold_rounds(rows_of(record));
  for (std::size_t k = 0; k < std::min(rows.size(), most_rows); ++k) {
    const BodyState& s = rows[k].state;
    table.add({{fmt::format("{:.9g}", rows[k].time)},
               {rows[k].what},
               {fmt::format("{:.4g}", s.h[0])},
               {body.contacts() == 2 ? fmt::format("{:.4g}", s.h[1]) : "-"},
               {fmt::format("{:.6g}", s.theta)}});
  }
  out += '\n' + table.print(false);
  if (rows.size() > most_rows) out += fmt::format("and {} lines more (in the JSON)\n", rows.size() - most_rows);
  if (record.omitted > 0) out += fmt::format("and {} events more, which were not kept\n", record.omitted);
  if (record.run.ambiguous > 0)
    out += fmt::format(
        "\n{} times more than one contact mode was consistent; the one that keeps most contacts was taken.\n",
        record.run.ambiguous);
  return out;
}

}  // namespace surefoot::planner
