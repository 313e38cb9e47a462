#include "tests/support/sample_scene.hpp"

#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace surefoot::testing {
namespace {

using Vertex = std::pair<double, double>;
struct Chain {
  std::vector<Vertex> vertices;
  std::vector<std::string> overrides;  // "index: {...}"
};

struct SceneText {
  std::vector<Chain> chains;
  double friction = 0.6, reach_min = 0.2, reach_max = 0.9, rho = 0.18, clearance = 0.15, kappa = 0.1, nu = 0.03;
  bool equilibrium = false;
  std::string start, goal;

  std::string write() const {
    std::ostringstream out;
    out.precision(17);
    out << "surefoot: 1\nterrain:\n  friction: " << friction << "\n  chains:\n";
    for (const Chain& chain : chains) {
      out << "    - vertices: [";
      for (std::size_t k = 0; k < chain.vertices.size(); ++k)
        out << (k ? ", " : "") << "[" << chain.vertices[k].first << ", " << chain.vertices[k].second << "]";
      out << "]\n";
      if (chain.overrides.empty()) continue;
      out << "      segments:\n";
      for (const std::string& line : chain.overrides) out << "        " << line << "\n";
    }
    out << "robot: {radius_of_gyration: " << rho << ", reach: [" << reach_min << ", " << reach_max
        << "], clearance: " << clearance << "}\ndisturbance: {kappa: " << kappa << ", nu: " << nu << "}\n";
    if (equilibrium) out << "stability: {criterion: equilibrium}\n";
    out << "start:\n  feet: " << start << "\n  support: [1, 2]\ngoal: " << goal << "\n";
    return out.str();
  }
};

std::string text(double value) {
  std::ostringstream out;
  out.precision(17);
  out << value;
  return out.str();
}
std::string friction_of(std::size_t segment, double mu) {
  return std::to_string(segment) + ": {friction: " + text(mu) + "}";
}
std::string barred(std::size_t segment) { return std::to_string(segment) + ": {foothold: false}"; }
std::string feet_at(double a, double b, double c) {
  return "[{x: " + text(a) + "}, {x: " + text(b) + "}, {x: " + text(c) + "}]";
}
std::string within(const char* axis, double from, double to) {
  return std::string("{com_") + axis + ": [" + text(from) + ", " + text(to) + "]}";
}

class Sampler {
 public:
  explicit Sampler(std::uint32_t seed) : engine_(seed) {}

  std::string draw(SceneKind kind) {
    draw_robot();
    if (kind == SceneKind::chimney) {
      chimney();
    } else {
      ground(kind);
      const double r = scene_.reach_max;
      scene_.start = feet_at(-0.45 * r, 0.2 * r, -0.1 * r);
      scene_.goal = within("x", end_ - 0.5 * r, end_ + 0.1 * r);
    }
    return scene_.write();
  }

 private:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool chance(double p) { return in(0, 1) < p; }

  void draw_robot() {
    const double r = scene_.reach_max = in(0.6, 1.3);
    scene_.reach_min = chance(0.2) ? 0 : in(0.1, 0.3) * r;
    scene_.clearance = chance(0.2) ? 0 : in(0.02, 0.25) * r;
    scene_.rho = in(0.08, 0.4) * r;
    scene_.kappa = chance(0.15) ? 0 : in(0.01, 0.2);
    scene_.nu = chance(0.15) ? 0 : in(0.01, 0.06) * r;
    scene_.friction = in(0.35, 1);
    scene_.equilibrium = chance(0.3);
  }

  // Level ground up to x = 0.6 r at first, level ground from `end_` - r at last; between them what the kind says.
  void ground(SceneKind kind) {
    const double r = scene_.reach_max;
    Chain chain;
    chain.vertices = {{-1.5 * r, 0}, {0.6 * r, 0}};
    x_ = 0.6 * r, y_ = 0;
    switch (kind) {
      case SceneKind::rubble: rubble(chain); break;
      case SceneKind::stairs: stairs(chain); break;
      case SceneKind::slope: slope(chain, in(0.85, 1.5)); break;
      case SceneKind::gap: gap(chain); break;
      case SceneKind::vee: vee(chain); break;
      case SceneKind::overhang: overhang(chain); break;
      case SceneKind::ice: patches(chain, true); break;
      case SceneKind::barred: patches(chain, false); break;
      case SceneKind::wall: wall(chain); break;
      case SceneKind::chimney: break;
    }
    to(chain, 2 * r, 0);
    end_ = x_ - r;
    scene_.chains.push_back(chain);
    if (roof_.vertices.size() > 1) scene_.chains.push_back(roof_);
  }
  void to(Chain& chain, double dx, double dy) { chain.vertices.emplace_back(x_ += dx, y_ += dy); }

  void rubble(Chain& chain) {
    const double r = scene_.reach_max, rough = in(0.1, 0.6) * r;
    for (int k = 0; k < 8; ++k) {
      const double y = in(-0.5, 0.5) * rough;
      to(chain, in(0.1, 0.5) * r, y - y_);
      if (chance(0.2)) chain.overrides.push_back(friction_of(chain.vertices.size() - 2, in(0.1, 0.6)));
    }
  }
  void stairs(Chain& chain) {
    const double r = scene_.reach_max, rise = in(0.1, 0.8) * r * (chance(0.5) ? 1 : -1), tread = in(0.2, 0.8) * r;
    for (int k = 0; k < 3; ++k) {
      to(chain, 0, rise);
      to(chain, tread, 0);
    }
  }
  void slope(Chain& chain, double of_friction) {
    const double r = scene_.reach_max, steep = scene_.friction * of_friction * (chance(0.5) ? 1 : -1);
    const double length = in(1, 3) * r;
    to(chain, length, steep * length);
  }
  void gap(Chain& chain) {
    const double r = scene_.reach_max;
    to(chain, 0, -2 * r);
    scene_.chains.push_back(chain);
    const double width = in(0.3, 1.7) * r, rise = in(-0.5, 0.5) * r;
    chain = {};
    x_ += width;
    chain.vertices = {{x_, y_}};
    to(chain, 0, 2 * r + rise);
  }
  void vee(Chain& chain) {
    const double r = scene_.reach_max, steep = in(0.3, 1.3) * scene_.friction * (chance(0.5) ? 1 : -1);
    const double half = in(0.6, 2) * r;
    to(chain, half, -steep * half);
    to(chain, half, steep * half);
  }
  void overhang(Chain& chain) {
    const double r = scene_.reach_max, length = in(0.5, 2.5) * r, height = in(1, 3) * scene_.clearance + in(0, 0.6) * r;
    roof_.vertices = {{x_ + length, y_ + height + in(0.01, 0.3) * r}, {x_, y_ + height}};
    if (chance(0.5)) roof_.vertices.insert(roof_.vertices.begin(), {x_ + length, y_ + height + 2 * r});
    if (chance(0.5)) roof_.vertices.emplace_back(x_, y_ + height + 2 * r);
    to(chain, length, 0);
  }
  void patches(Chain& chain, bool ice) {
    const double r = scene_.reach_max;
    for (int k = 0; k < 2; ++k) {
      to(chain, in(0.3, 1.8) * r, 0);
      const std::size_t segment = chain.vertices.size() - 2;
      chain.overrides.push_back(ice ? friction_of(segment, in(0.2, 2) * scene_.kappa) : barred(segment));
      to(chain, in(0.1, 0.6) * r, 0);
    }
  }
  void wall(Chain& chain) {
    const double r = scene_.reach_max, height = in(0.2, 1) * r * (chance(0.5) ? 1 : -1);
    to(chain, 0, height);
    to(chain, in(0.1, 1.2) * r, 0);
    to(chain, 0, -height);
  }
  void chimney() {
    const double r = scene_.reach_max, width = in(0.8, 1.3) * r, top = 5 * r;
    scene_.equilibrium = chance(0.8);
    Chain left, right;
    const auto bend = [&] { return in(-0.15, 0.15) * r; };
    for (double y = top; y > -r; y -= in(0.4, 1) * r) left.vertices.emplace_back(bend(), y);
    for (double y = -1.5 * r; y < top; y += in(0.4, 1) * r) right.vertices.emplace_back(width + bend(), y);
    if (chance(0.4)) right.overrides.push_back(friction_of(right.vertices.size() / 2, in(0, 0.3)));
    double length = 0;
    for (std::size_t k = 1; k < left.vertices.size(); ++k)
      length += std::hypot(left.vertices[k].first - left.vertices[k - 1].first,
                           left.vertices[k].second - left.vertices[k - 1].second);
    scene_.start = "[{chain: 0, s: " + text(length - 1.1 * r) + "}, {chain: 1, s: " + text(1.6 * r) +
                   "}, {chain: 0, s: " + text(length - 0.8 * r) + "}]";
    scene_.chains = {left, right};
    scene_.goal = within("y", 1.8 * r, 2.4 * r);
  }

  std::mt19937 engine_;
  SceneText scene_;
  Chain roof_;
  double x_ = 0, y_ = 0, end_ = 0;
};

}  // namespace

const char* to_string(SceneKind kind) {
  constexpr const char* names[] = {"rubble",   "stairs",  "slope", "gap",    "vee",
                                   "overhang", "chimney", "ice",   "barred", "wall"};
  return names[static_cast<int>(kind)];
}

std::string sample_scene(SceneKind kind, std::uint32_t seed) {
  return Sampler(seed * static_cast<std::uint32_t>(scene_kinds) + static_cast<std::uint32_t>(kind)).draw(kind);
}

const char* to_string(Family family) {
  constexpr const char* names[] = {"gap_width",  "step_height", "drop_depth",  "slope_friction",
                                   "ice_length", "bar_length",  "wall_height", "ceiling_height"};
  return names[static_cast<int>(family)];
}

std::pair<double, double> easy_and_hopeless(Family family) {
  switch (family) {
    case Family::gap_width:
    case Family::ice_length:
    case Family::bar_length: return {0.2, 2};
    case Family::step_height: return {0.1, 2};
    case Family::drop_depth: return {0.1, 2};
    case Family::slope_friction: return {1, 0.2};
    case Family::wall_height: return {0.1, 1.5};
    case Family::ceiling_height: return {1.5, 0.2};
  }
  return {0, 0};
}

std::string family_scene(Family family, double value) {
  SceneText scene;
  scene.start = "[{x: -0.4}, {x: 0.2}, {x: -0.1}]";
  Chain a{{{-1.5, 0}, {1, 0}}, {}}, b;
  double x = 1, y = 0;
  const auto to = [&](double dx, double dy) { a.vertices.emplace_back(x += dx, y += dy); };
  switch (family) {
    case Family::gap_width:
      to(0, -1.5);
      b.vertices = {{1 + value, -1.5}, {1 + value, 0}, {3.5 + value, 0}};
      x += value;
      break;
    case Family::step_height: to(0, value); break;
    case Family::drop_depth: to(0, -value); break;
    case Family::slope_friction:
      to(2.8, 1.0191);
      a.overrides = {friction_of(1, value)};
      break;
    case Family::ice_length:
      to(value, 0);
      a.overrides = {friction_of(1, 0.05)};
      break;
    case Family::bar_length:
      to(value, 0);
      a.overrides = {barred(1)};
      break;
    case Family::wall_height: to(0, value), to(0.2, 0), to(0, -value); break;
    case Family::ceiling_height:
      b.vertices = {{3.6, 1.6}, {3.5, value}, {1.1, value}, {1, 1.6}};
      if (value >= 1.6) b.vertices = {{3.5, value}, {1.1, value}};
      to(2.6, 0);
      break;
  }
  if (b.vertices.empty() || family == Family::ceiling_height) to(2.5, 0);
  scene.chains = {a};
  if (!b.vertices.empty()) scene.chains.push_back(b);
  const double from = family == Family::gap_width ? x + 1.2 : x - 1.3;
  scene.goal = within("x", from, from + 0.5);
  return scene.write();
}

}  // namespace surefoot::testing
