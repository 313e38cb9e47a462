// A plan as a table for people.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gaits/plan_io.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/text_table.hpp"

namespace surefoot::gaits {
namespace {

constexpr const char* bold = "1";
constexpr const char* red = "31";
constexpr const char* green = "32";
constexpr const char* yellow = "1;33";

/// Control characters (a name may hold any) would break lines or talk to the terminal.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string legs_text(const std::vector<int>& legs) {
  std::string text;
  for (const int leg : legs) text += fmt::format("{}{}", text.empty() ? "" : " ", leg + 1);
  return text.empty() ? "-" : text;
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : printable(text); }

class Report {
 public:
  Report(const Scene& scene, const Plan& plan, const TextOptions& options)
      : scene_(scene), plan_(plan), options_(options), least_(weakest_place(plan)) {}

  std::string print() const {
    std::string text = heading();
    if (!plan_.stances.empty()) text.append("\n").append(table());
    text.append("\n").append(summary());
    if (options_.explain && !plan_.stances.empty()) text += limits();
    return text + left_out();
  }

  std::string explanation() const { return resolution() + limits() + left_out(); }

 private:
  std::string heading() const {
    static const std::map<Status, const char*> words{{Status::solved, "solved"},
                                                     {Status::no_plan_found, "no plan found"},
                                                     {Status::infeasible, "infeasible"}};
    const std::string status = words.at(plan_.status);
    std::string text = paint(printable(plan_.scene), bold, options_.colour) + ": " +
                       paint(status, plan_.status == Status::solved ? green : red, options_.colour);
    if (plan_.status == Status::solved)
      text += fmt::format(" in {} step{}", plan_.steps(), plan_.steps() == 1 ? "" : "s");
    return text + reason(status) + "\n";
  }

  /// Clause by clause; the status is not said twice.
  std::string reason(const std::string& status) const {
    std::string text = printable(plan_.reason);
    if (text.empty()) return text;
    for (std::size_t at = 0; (at = text.find("; ", at)) != std::string::npos;) text.replace(at, 2, "\n  ");
    return text.starts_with(status + " ") ? text.substr(status.size()) : " - " + text;
  }

  std::string length(double metres) const { return length_in_words(metres, scene_.robot.reach_max); }

  std::string point(const Eigen::Vector2d& p) const {
    return fmt::format("{:>{}} {:>{}}", length(p.x()), x_width(), length(p.y()), x_width());
  }

  /// One width for all coordinates of the plan keeps the points of a column aligned.
  std::size_t x_width() const {
    if (width_ > 0) return width_;
    const auto fit = [&](const Eigen::Vector2d& p) {
      for (const double v : {p.x(), p.y()}) width_ = std::max(width_, length(v).size());
    };
    const auto fit_feet = [&](const Feet& feet) {
      for (const auto& foot : feet)
        if (foot) fit(foot->position);
    };
    fit_feet(scene_.start.feet);
    for (const Stance& stance : plan_.stances) fit(stance.com), fit_feet(stance.feet);
    for (const Transfer& transfer : plan_.transfers) fit(transfer.foothold.position);
    return width_;
  }

  std::string table() const {
    using Align = TextTable::Align;
    TextTable table({{"", "step", Align::right},
                     {"foot [m]", "leg", Align::right},
                     {"", "from", Align::left},
                     {"", "to", Align::left},
                     {"legs", "support", Align::left},
                     {"COM [m]", "from", Align::left},
                     {"", "to", Align::left},
                     {"leg", "lifted", Align::left},
                     {"stance", "safety", Align::right},
                     {"", "limit", Align::left},
                     {"transfer", "safety", Align::right},
                     {"", "limit", Align::left}});
    Feet last = scene_.start.feet;  // where each leg stood last
    for (int k = 0; k < static_cast<int>(plan_.stances.size()); ++k) {
      const Stance& stance = plan_.stances[k];
      for (int leg = 0; leg < leg_count; ++leg)
        if (stance.feet[leg]) last[leg] = stance.feet[leg];
      table.add(k < plan_.steps() ? step_row(k, last) : last_row(k));
    }
    return table.print(options_.colour);
  }

  TextTable::Cell sigma_cell(double sigma, bool in_transfer, int k) const {
    return {factor_in_words(sigma), least_.index == k && least_.in_transfer == in_transfer ? yellow : nullptr};
  }

  std::vector<TextTable::Cell> step_row(int k, const Feet& last) const {
    const Stance& stance = plan_.stances[k];
    const Transfer& transfer = plan_.transfers[k];
    const bool has_next = k + 1 < static_cast<int>(plan_.stances.size());
    return {{std::to_string(k + 1)},
            {std::to_string(transfer.leg + 1)},
            {last[transfer.leg] ? point(last[transfer.leg]->position) : "in the air"},
            {point(transfer.foothold.position)},
            {legs_text(planted_legs(stance.feet))},
            {point(stance.com)},
            {has_next ? point(plan_.stances[k + 1].com) : "-"},
            {std::to_string(transfer.lift + 1)},
            sigma_cell(stance.safety_factor, false, k),
            {or_dash(stance.limit)},
            sigma_cell(transfer.safety_factor, true, k),
            {or_dash(transfer.limit)}};
  }

  std::vector<TextTable::Cell> last_row(int k) const {
    const Stance& stance = plan_.stances[k];
    return {{"end"},
            {},
            {},
            {},
            {legs_text(planted_legs(stance.feet))},
            {point(stance.com)},
            {},
            {},
            sigma_cell(stance.safety_factor, false, k),
            {or_dash(stance.limit)},
            {},
            {}};
  }

  std::string summary() const {
    std::string text;
    if (!plan_.stances.empty()) {
      double travelled = 0;
      for (std::size_t k = 1; k < plan_.stances.size(); ++k)
        travelled += (plan_.stances[k].com - plan_.stances[k - 1].com).norm();
      text += fmt::format("{} step{}, COM travels {} m, least safety factor {}", plan_.steps(),
                          plan_.steps() == 1 ? "" : "s", length(travelled),
                          paint(factor_in_words(plan_.safety_factor), bold, options_.colour));
      text += where();
      if (plan_.safety_factor_before_refinement)
        text += fmt::format(", {} before refinement", factor_in_words(*plan_.safety_factor_before_refinement));
      text += "\n";
    }
    if (plan_.status == Status::infeasible) return text + fmt::format("proven in {:.3f} s\n", plan_.time_s);
    return text + fmt::format("planner {}, seed {}, {:.3f} s\n", or_dash(plan_.planner), plan_.seed, plan_.time_s) +
           resolution();
  }

  std::string resolution() const {
    if (!plan_.resolution || !options_.explain) return "";
    const Resolution& reached = *plan_.resolution;
    const std::string lattice = fmt::format("footholds {:.3g} m apart and {} columns of COMs on each pair",
                                            reached.foothold_spacing, reached.com_columns);
    if (plan_.steps() <= reached.least_steps) return "No plan has fewer steps: reach alone forbids it.\n";
    return fmt::format("{} {}; whatever the lattice, {} step{} at least.\n",
                       reached.fewest_on_lattice ? "No plan of fewer steps on"
                                                 : "Fewer steps are not ruled out: searched on",
                       lattice, reached.least_steps, reached.least_steps == 1 ? "" : "s");
  }

  std::string where() const {
    if (std::isinf(least_.sigma)) return "";
    return fmt::format(" in {}{}", place_in_words(least_, plan_.steps()),
                       least_.limit.empty() ? "" : " (" + printable(least_.limit) + ")");
  }

  /// "1-3, 7, end"
  std::string steps_text(const std::vector<int>& steps) const {
    const auto name = [&](int step) { return step > plan_.steps() ? std::string("end") : std::to_string(step); };
    std::string text;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::size_t first = i;
      while (i + 1 < steps.size() && steps[i + 1] == steps[i] + 1) ++i;
      text += (first == 0 ? "" : ", ") + name(steps[first]);
      if (i > first) text += (i == first + 1 ? ", " : "-") + name(steps[i]);
    }
    return text;
  }

  /// What limits each step: one entry per limit and set of legs, with the steps where it is met.
  std::string limits() const {
    struct Entry {
      std::string limit;
      std::vector<int> legs;
      std::vector<int> stances, transfers;  // by step
    };
    std::vector<Entry> entries;
    const auto note = [&](const std::string& limit, const Feet& feet, int k, bool in_transfer) {
      if (limit.empty()) return;
      const std::vector<int> legs = planted_legs(feet);
      const auto same = [&](const Entry& e) { return e.limit == limit && e.legs == legs; };
      auto entry = std::find_if(entries.begin(), entries.end(), same);
      if (entry == entries.end()) entry = entries.insert(entries.end(), {limit, legs, {}, {}});
      (in_transfer ? entry->transfers : entry->stances).push_back(k + 1);
    };
    for (int k = 0; k < static_cast<int>(plan_.stances.size()); ++k) {
      note(plan_.stances[k].limit, plan_.stances[k].feet, k, false);
      if (k < plan_.steps()) note(plan_.transfers[k].limit, feet_during(plan_.stances[k], plan_.transfers[k]), k, true);
    }
    if (entries.empty()) return "";
    std::string text("\n");
    text +=
        paint("What limits the steps", bold, options_.colour) + " (+t: along the ground with free space on the left)\n";
    for (const Entry& entry : entries) {
      text += fmt::format("  {} on legs {}: {}\n", printable(entry.limit), legs_text(entry.legs),
                          printable(limit_in_words(entry.limit, entry.legs)));
      if (!entry.stances.empty())
        text += (entry.stances.front() > plan_.steps() ? "      the last stance"
                                                       : "      stance of step " + steps_text(entry.stances)) +
                "\n";
      if (!entry.transfers.empty()) text += "      transfer of step " + steps_text(entry.transfers) + "\n";
    }
    return text;
  }

  std::string left_out() const {
    if (plan_.left_out.empty()) return "";
    std::string text("\n");
    text += paint("Not computed", bold, options_.colour) + "\n";
    for (const LeftOut& item : plan_.left_out)
      text += fmt::format("  {}: {}\n", printable(item.what), printable(item.why));
    return text;
  }

  const Scene& scene_;
  const Plan& plan_;
  const TextOptions& options_;
  WeakestPlace least_;
  mutable std::size_t width_ = 0;
};

}  // namespace

std::string to_text(const Scene& scene, const Plan& plan, const TextOptions& options) {
  return Report(scene, plan, options).print();
}

std::string explanation(const Scene& scene, const Plan& plan) {
  const TextOptions options{.explain = true};
  return Report(scene, plan, options).explanation();
}

}  // namespace surefoot::gaits
