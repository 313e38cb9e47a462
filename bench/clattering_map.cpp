// What becomes of pushed rods in the (e, psi) plane of [OR-H, Fig. 2]: above the curve of (10), between it and the
// dashed curve of clattering without gravity, and below both. Writes a picture and prints a table; see README.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "gaits/svg_canvas.hpp"
#include "stability/frictional.hpp"
#include "stability/hybrid_dynamics.hpp"

using namespace surefoot;
using Eigen::Vector2d;
using gaits::Polyline;
using stability::HybridEvent;
using stability::HybridRun;

namespace {

constexpr double half_length = 0.5, gravity = 9.81, friction = 0.5;

/// The symmetric rod: psi_1 = psi_2 = psi = (L^2 - rho^2) / (L^2 + rho^2).
stability::HybridBody rod(double psi) {
  const std::vector<stability::Contact> ends{{{-half_length, 0}, {0, 1}, friction},
                                             {{half_length, 0}, {0, 1}, friction}};
  return {ends, Vector2d::Zero(), half_length * std::sqrt((1 - psi) / (1 + psi)), gravity, true};
}

/// Below which clattering without gravity does not alternate for ever.
double dashed(double e) { return 2 * std::sqrt(e) / (1 + e); }

/// What came of one push.
struct Fate {
  bool rest = false, undecided = false, two_contacts = false, one_contact = false;  // its end; the first accumulation
  double collisions = 0;                                                            // before the first accumulation
  double alternating = 0;  // greatest number in a row of them by turns
};

Fate push(const stability::HybridBody& body, double e, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  // Heights of the ends up to 1 cm, rates of the order of falls from there.
  double h[2], rate[2];
  for (int i : {0, 1}) {
    h[i] = 1e-2 * unit(random);
    rate[i] = (2 * unit(random) - 1) * std::sqrt(2 * gravity * h[i]);
  }
  const auto mean = [](const double* v) { return 0.5 * (v[0] + v[1]); };
  const auto turn = [](const double* v) { return (v[1] - v[0]) / (2 * half_length); };
  const auto start = body.state_at({0, mean(h), turn(h)}, {0, mean(rate), turn(rate)});
  stability::HybridOptions options;
  options.restitution = e, options.neighbourhood = 1, options.time_limit = 1e4;
  Fate fate;
  bool before = true;
  int last = -1;
  double row = 0;
  const HybridRun run = simulate(body, start, options, [&](const HybridEvent& event) {
    using Kind = HybridEvent::Kind;
    if (!before) return;
    if (event.kind == Kind::collision) {
      ++fate.collisions;
      row = event.contact == last ? 1 : row + 1;
      last = event.contact;
      fate.alternating = std::max(fate.alternating, row);
    }
    fate.two_contacts = event.kind == Kind::clattering || event.kind == Kind::chattering;
    fate.one_contact = event.kind == Kind::bouncing;
    before = !fate.two_contacts && !fate.one_contact && event.kind != Kind::dies_out;
  });
  fate.rest = run.outcome == HybridRun::Outcome::rest;
  fate.undecided = run.outcome == HybridRun::Outcome::undecided;
  return fate;
}

struct Cell {
  double e, psi;
  std::vector<Fate> fates;
  double share(bool Fate::*what) const {
    return static_cast<double>(std::count_if(fates.begin(), fates.end(), [&](const Fate& f) { return f.*what; })) /
           static_cast<double>(fates.size());
  }
};

/// Pushes of rods drawn evenly between two curves psi(e).
void print(const char* name, int pushes, double (*low)(double), double (*high)(double), std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  Cell all{0, 0, {}};
  while (static_cast<int>(all.fates.size()) < pushes) {
    const double e = unit(random), psi = low(e) + unit(random) * (high(e) - low(e));
    // 1 / (1 - e) collisions per decade of speed: nearer to 1 the limits of a run, not the rod, decide.
    if (e < 0.99 && psi < 1) all.fates.push_back(push(rod(psi), e, random));
  }
  const auto quantile = [&](double Fate::*what, double q) {
    std::vector<double> values;
    for (const Fate& fate : all.fates) values.push_back(fate.*what);
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
  };
  fmt::print("| {} | {} | {:.2f} % | {:.2f} % | {:.1f} % | {:.1f} % | {:.0f} | {:.0f} | {:.0f} |\n", name,
             all.fates.size(), 100 * all.share(&Fate::rest), 100 * all.share(&Fate::undecided),
             100 * all.share(&Fate::two_contacts), 100 * all.share(&Fate::one_contact),
             quantile(&Fate::collisions, 0.5), quantile(&Fate::collisions, 0.99), quantile(&Fate::alternating, 0.99));
}

std::string picture(const std::vector<Cell>& cells, int columns) {
  constexpr double left = 70, top = 70, side = 480, key = 300;  // [px]
  gaits::SvgCanvas canvas(left + side + key, top + side + 60, "Clattering of a rod in the (e, psi) plane");
  const auto at = [&](double e, double psi) { return Vector2d(left + side * e, top + side * (1 - psi)); };
  canvas.text({left, 30}, "What ends the collisions of a pushed rod", {.size = 18, .bold = true});
  canvas.text({left, 50}, "Share of pushes whose first accumulation is at both ends at once; curves of [OR-H, Fig. 2]",
              {.size = 12, .colour = "#666"});
  const auto shade = [](double share) {
    const auto mix = [share](int from, int to) { return static_cast<int>(std::lround(from + share * (to - from))); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(0xff, 0x1f), mix(0xf4, 0x78), mix(0xdc, 0xb4));
  };
  const double half = 0.5 / columns;
  for (const Cell& cell : cells) {
    const std::string colour = shade(cell.share(&Fate::two_contacts));
    canvas.rectangle(at(cell.e - half, cell.psi + half), side / columns, side / columns,
                     {.fill = colour, .stroke = colour, .width = 0.3});
  }
  Polyline threshold, zero_gravity;
  for (int k = 0; k <= 200; ++k) {
    const double e = k / 200.0;
    threshold.push_back(at(e, std::min(1.0, k == 0 ? 0 : stability::clattering_threshold(e))));
    zero_gravity.push_back(at(e, dashed(e)));
  }
  canvas.polyline(threshold, {.stroke = "#111", .width = 2.2});
  canvas.polyline(zero_gravity, {.stroke = "#111", .width = 1.6, .dash = "7 5"});
  canvas.rectangle({left, top}, side, side, {.stroke = "#333", .width = 1});
  for (int k = 0; k <= 5; ++k) {
    const double v = k / 5.0;
    canvas.text(at(v, 0) + Vector2d(0, 18), fmt::format("{:g}", v), {.anchor = "middle"});
    canvas.text(at(0, v) + Vector2d(-10, 4), fmt::format("{:g}", v), {.anchor = "end"});
  }
  canvas.text(at(0.5, 0) + Vector2d(0, 42), "restitution e", {.size = 13, .anchor = "middle"});
  canvas.text(at(0, 0.5) + Vector2d(-50, 0), "psi", {.size = 13, .anchor = "middle"});
  const double x = left + side + 20;
  double y = top + 16;
  canvas.line({x, y - 4}, {x + 30, y - 4}, {.stroke = "#111", .width = 2.2});
  canvas.text({x + 38, y}, "(10): above it, Theorem 2");
  y += 22;
  canvas.line({x, y - 4}, {x + 30, y - 4}, {.stroke = "#111", .width = 1.6, .dash = "7 5"});
  canvas.text({x + 38, y}, "without gravity: above it for ever");
  y += 30;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const std::string colour = shade(share);
    canvas.rectangle({x, y - 11}, 30, 14, {.fill = colour, .stroke = "#777", .width = 0.5});
    canvas.text({x + 38, y}, fmt::format("{:g} % at both ends", 100 * share));
    y += 20;
  }
  return canvas.finish();
}

}  // namespace

int main(int count, char** words) {
  CLI::App app("What becomes of pushed rods in the (e, psi) plane of [OR-H, Fig. 2].");
  int columns = 40, pushes = 20, samples = 4000;
  std::string svg;
  app.add_option("--columns", columns, "cells along either axis")->check(CLI::PositiveNumber);
  app.add_option("--pushes", pushes, "random ones per cell")->check(CLI::PositiveNumber);
  app.add_option("--samples", samples, "random rods per row of the table")->check(CLI::PositiveNumber);
  app.add_option("--svg", svg, "picture");
  CLI11_PARSE(app, count, words);
  std::mt19937_64 random(20261125);
  std::vector<Cell> cells;
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < columns; ++k) {
      Cell cell{(i + 0.5) / columns, (k + 0.5) / columns, {}};
      const auto body = rod(cell.psi);
      for (int n = 0; n < pushes; ++n) cell.fates.push_back(push(body, cell.e, random));
      cells.push_back(cell);
    }
  const auto zero = [](double) { return 0.0; };
  const auto one = [](double) { return 1.0; };
  fmt::print(
      "| place | pushes | end at rest | undecided | first accumulation at both ends | at one end | collisions before "
      "it, median | 99 % | "
      "by turns in a row, 99 % |\n|---|---|---|---|---|---|---|---|---|\n");
  print("above (10)", samples, stability::clattering_threshold, one, random);
  print("between the curves", samples, dashed, stability::clattering_threshold, random);
  print("below both", samples, zero, dashed, random);
  if (!svg.empty()) std::ofstream(svg) << picture(cells, columns);
  return 0;
}
