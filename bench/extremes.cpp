// Writes docs/extremes.md: the catalogue of stiff and extreme postures, decided by plain doubles, by surefoot, by exact
// arithmetic and by a general LP solver. `extremes [FILE]`, standard output without one. All but the last table is the
// same on every run.
#include "bench/extremes.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <iostream>

namespace {

using surefoot::bench::GroupResult;
using surefoot::bench::Judge;
using surefoot::bench::Results;
using surefoot::bench::Telling;

std::string format(const char* pattern, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

GroupResult total(const Results& results) {
  GroupResult sum;
  const auto add = [](Judge& to, const Judge& from) {
    to.wrong += from.wrong, to.unsafe += from.unsafe, to.without += from.without, to.seconds += from.seconds;
  };
  for (const auto& [name, group] : results.groups) {
    sum.cases += group.cases, sum.robust += group.robust;
    add(sum.plain, group.plain), add(sum.ours, group.ours), add(sum.lp, group.lp), add(sum.exact, group.exact);
    auto& factor = sum.factor;
    factor.zero += group.factor.zero, factor.infinite += group.factor.infinite, factor.finite += group.factor.finite;
    factor.kinks += group.factor.kinks, factor.differ += group.factor.differ;
    factor.not_a_number += group.factor.not_a_number, factor.seconds += group.factor.seconds;
    factor.value = std::max(factor.value, group.factor.value);
    factor.gradient = std::max(factor.gradient, group.factor.gradient);
  }
  return sum;
}

void introduction(std::ostream& out, const GroupResult& sum) {
  out << "# Stiff and extreme cases\n\n"
         "Made by `extremes docs/extremes.md` (bench/README.md); do not edit. All but the last table is the same on "
         "every run.\n\n";
  out << format(
      "%d postures in which something is extreme, %d of them robustly stable. Each is decided in four ways:\n\n",
      sum.cases, sum.robust);
  out << "- **doubles**: the formulas written down in double precision without error bounds "
         "(tests/support/extreme_plain.cpp). "
         "Only parallels and\n  vanishing rows are asked with a tolerance, 1e-12, since without one level ground "
         "already fails;\n"
         "- **surefoot**: `RobustOracle`, what `surefoot query` answers;\n"
         "- **LP**: GLPK in the full unknowns, one program per corner of W and per mode "
         "(tests/support/extreme_lp.cpp);\n"
         "- **exact**: integer arithmetic (tests/support/exact_posture.hpp), which shares no formula with surefoot and "
         "is what the "
         "others are\n  held against.\n\n"
         "An answer is *wrong* where equilibrium, the set of feasible modes or the robust verdict differs; *unsafe* "
         "where it says "
         "robust and is\nwrong. NaN: some number in a row was not finite. None: the LP solver stopped in an error, ran "
         "in circles (1000 "
         "pivots) or was given\nnumbers that are not finite.\n\n";
}

void verdict_table(std::ostream& out, const Results& results, const GroupResult& sum) {
  out << "## Verdicts\n\n| group | cases | robust | doubles wrong (unsafe) | NaN | LP wrong (unsafe) | none | surefoot "
         "wrong |\n"
         "|---|---|---|---|---|---|---|---|\n";
  const auto line = [&](const std::string& name, const GroupResult& g) {
    out << "| " << name
        << format(" | %d | %d | %d (%d) | %d | %d (%d) | %d | %d |\n", g.cases, g.robust, g.plain.wrong, g.plain.unsafe,
                  g.plain.without, g.lp.wrong, g.lp.unsafe, g.lp.without, g.ours.wrong);
  };
  for (const std::string& name : results.order) line(name, results.groups.at(name));
  line("**all**", sum);
}

void what_goes_wrong(std::ostream& out) {
  out << R"(
Plain doubles hold out while numbers are merely large, small or shifted: scaling, shifts, friction and boxes of any size cost them few
answers. They fail where signs decide that are not in the leading digits: a foot above a foot and contacts that coincide or nearly
do (rows that vanish, or all but vanish, for every COM), opposed walls (two rows that are exact opposites), a COM within some units in
the last place of a boundary (a coin toss), and products that leave the range of doubles, where nearly every answer is lost, half of
them as NaN.

The LP solver fails for another reason: feasibility is a tolerance there, so a boundary is 1e-8 wide or wider. A COM on a boundary or a few
units in the last place from it is decided as if it were on either side, and the same happens to whole postures whose
numbers are small beside the tolerance: tiny friction, rho far from the contact distance, contacts 1e-9 apart. Where contacts coincide it also
meets singular bases; it stops with an error near the ends of the range of doubles.
)";
}

void factor_table(std::ostream& out, const Results& results, const GroupResult& sum) {
  out << R"(
## Safety factors and gradients

Against exact rational linear programs. Relative error of the factor; error of the gradient relative to |gradient| + factor / lever, the
lever being the greatest distance of a contact from the COM, where one-sided derivatives agree (no kink). `wrong`: zero, finite or
infinite instead of another of these.

| group | finite | 0 | inf | kinks | wrong | NaN | factor error | gradient error |
|---|---|---|---|---|---|---|---|---|
)";
  const auto line = [&](const std::string& name, const GroupResult& g) {
    out << "| " << name
        << format(" | %d | %d | %d | %d | %d | %d | %.0e | %.0e |\n", g.factor.finite, g.factor.zero, g.factor.infinite,
                  g.factor.kinks, g.factor.differ, g.factor.not_a_number, g.factor.value, g.factor.gradient);
  };
  for (const std::string& name : results.order) line(name, results.groups.at(name));
  line("**all**", sum);
}

void examples(std::ostream& out, const Results& results) {
  out << "\n## Telling cases\n\nOf each group the shortest that plain doubles, or else the LP, get wrong. The lines "
         "can be given to "
         "`surefoot query`.\n";
  for (const std::string& name : results.order) {
    for (const Telling& telling : results.telling) {
      if (telling.example.group != name) continue;
      out << "\n**" << name << "** (" << telling.example.name << ")\n```\n"
          << telling.example.sample.json() << "\n```\n";
      out << "exact and surefoot: " << telling.exact;
      if (telling.plain != telling.exact) out << "; doubles: " << telling.plain;
      if (telling.lp != telling.exact) out << "; LP: " << telling.lp;
      out << ".\n";
    }
  }
}

void limits_and_times(std::ostream& out, const Results& results, const GroupResult& sum) {
  out << R"(
## Limits

- Where rho^2, friction, kappa, nu or a distance from the COM lies outside [1e-70, 1e70] (zero is inside) the error bounds of doubles say
  nothing: everything is decided in exact arithmetic, some hundred times slower. The answers stay exact.
- Normals are only scaled; denormal ones are exact as well.
- A factor beyond the doubles is written as inf, one below them as 0; the same holds for components of gradients.
- Where D = 0 both signs are tested and rows that vanish are dropped: conventions, shared by surefoot and the exact reference.
- Gradients at kinks (several constraints at once, a corner of the box) are those of one constraint.

## Times

Mean time per posture [us], measured in this run: the verdict (equilibrium, all modes, robust; contacts prepared for surefoot) and
surefoot's safety factor with gradient.

| group | doubles | surefoot | factor | LP | exact |
|---|---|---|---|---|---|
)";
  const auto line = [&](const std::string& name, const GroupResult& g) {
    const double unit = 1e6 / g.cases;
    out << "| " << name
        << format(" | %.3g | %.3g | %.3g | %.3g | %.3g |\n", g.plain.seconds * unit, g.ours.seconds * unit,
                  g.factor.seconds * unit, g.lp.seconds * unit, g.exact.seconds * unit);
  };
  for (const std::string& name : results.order) line(name, results.groups.at(name));
  line("**all**", sum);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) {
    std::cerr << "usage: extremes [FILE]\n";
    return 2;
  }
  const Results results = surefoot::bench::judged_catalogue();
  std::ofstream file;
  if (argc == 2) file.open(argv[1]);
  std::ostream& out = argc == 2 ? file : std::cout;
  const GroupResult sum = total(results);
  introduction(out, sum);
  verdict_table(out, results, sum);
  what_goes_wrong(out);
  factor_table(out, results, sum);
  examples(out, results);
  limits_and_times(out, results, sum);
  out.flush();
  if (!out) {
    std::cerr << "extremes: cannot write\n";
    return 2;
  }
  return sum.ours.wrong + sum.factor.differ + sum.factor.not_a_number == 0 ? 0 : 1;
}
