#include "gaits/plan_heading.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace surefoot::gaits {

using Eigen::Vector2d;

namespace {

/// At most so many bytes, whole characters (UTF-8).
std::string cut(std::string words, double room) {
  auto most = static_cast<std::size_t>(std::max(room, 3.0)) - 3;
  if (words.size() <= most + 3) return words;
  while (most > 0 && (static_cast<unsigned char>(words[most]) & 0xc0) == 0x80) --most;
  return words.substr(0, most) + "...";
}

std::string subtitle(const Plan& plan, const std::vector<std::string>& faults, const WeakestPlace& weakest) {
  if (!faults.empty())
    return fmt::format("REFUSED by the verifier, {} fault{}: {}", faults.size(), faults.size() == 1 ? "" : "s",
                       faults.front());
  if (!plan.reason.empty()) return plan.reason;
  if (!weakest.bounded() || weakest.limit.empty()) return "";
  const Stance& stance = plan.stances[weakest.index];
  const Feet feet = weakest.in_transfer ? feet_during(stance, plan.transfers[weakest.index]) : stance.feet;
  return fmt::format("least in {} ({}: {})", place_in_words(weakest, plan.steps()), weakest.limit,
                     limit_in_words(weakest.limit, planted_legs(feet)));
}

void title_and_scale(SvgCanvas& canvas, const Page& page, const std::string& title, const Plan& plan,
                     const std::vector<std::string>& faults, const WeakestPlace& weakest) {
  canvas.text({30, 36}, title, {.size = 20, .bold = true});
  canvas.text({30, 58}, cut(subtitle(plan, faults, weakest), (page.width - 60) / (faults.empty() ? 6.9 : 7.7)),
              {.size = 13, .colour = faults.empty() ? faint : alarm, .bold = !faults.empty()});
  const double metres = round_length(160 / page.scale);
  const double left = page.width - 30 - metres * page.scale, right = page.width - 30;
  canvas.line({left, 40}, {right, 40}, com_line);
  for (const double x : {left, right}) canvas.line({x, 36}, {x, 44}, com_line);
  canvas.text({(left + right) / 2, 32}, fmt::format("{:g} m", metres), {.anchor = "middle"});
}

/// Entries flow over at most two lines; widths are estimates, the font is the viewer's.
void legend(SvgCanvas& canvas, const Page& page, const Plan& plan, bool refused, const WeakestPlace& weakest,
            const TerrainPicture& terrain) {
  double x = 30, y = 82;
  const auto entry = [&](const std::string& words, auto&& symbol) {
    const double width = 44 + 6.9 * static_cast<double>(words.size());
    if (x + width > page.width - 30 && x > 30) x = 30, y += 20;
    symbol(Vector2d(x, y));
    canvas.text({x + 28, y + 4}, words);
    x += width;
  };
  const Vector2d across(22, 0), middle(11, 0);
  for (int leg = 0; leg < leg_count; ++leg)
    entry(fmt::format("leg {}", leg + 1), [&](const Vector2d& at) { draw_badge(canvas, at + middle, leg); });
  if (!plan.stances.empty())
    entry("COM by step", [&](const Vector2d& at) {
      canvas.line(at, at + across, com_line);
      canvas.circle(at + middle, dot_radius, com_dot);
    });
  if (weakest.bounded())
    entry(refused ? "least safety factor stated" : "least safety factor",
          [&](const Vector2d& at) { canvas.line(at, at + across, weak_line); });
  const auto box = [&](const Vector2d& at, const Paint& paint) {
    canvas.rectangle(at - Vector2d(0, 6), 22, 12, paint);
  };
  if (!plan.stances.empty())
    entry("R_SS(W) within reach: COMs in balance", [&](const Vector2d& at) {
      box(at, {.fill = support_colour, .opacity = 0.25});
      box(at, support_edge);
    });
  entry("goal", [&](const Vector2d& at) { box(at, {.fill = goal_colour, .opacity = 0.45}); });
  for (const auto& key : terrain.legend())
    entry(key.label, [&](const Vector2d& at) {
      canvas.line(at, at + across, key.paint);
      if (key.overlay) canvas.line(at, at + across, *key.overlay);
      if (key.hatching)
        for (double right = 6; right <= across.x(); right += 5)
          canvas.line(at + Vector2d(right, 0), at + Vector2d(right - 5, 5), *key.hatching);
    });
}

}  // namespace

void draw_badge(SvgCanvas& canvas, const Vector2d& at, int leg) {
  canvas.circle(at, badge_radius, {.fill = leg_colour[leg]});
  canvas.text(at + Vector2d(0, 3.2), std::to_string(leg + 1),
              {.size = 9, .colour = "#fff", .anchor = "middle", .bold = true});
}

void draw_heading(SvgCanvas& canvas, const Page& page, const std::string& title, const Plan& plan,
                  const std::vector<std::string>& faults, const WeakestPlace& weakest, const TerrainPicture& terrain) {
  title_and_scale(canvas, page, title, plan, faults, weakest);
  legend(canvas, page, plan, !faults.empty(), weakest, terrain);
}

}  // namespace surefoot::gaits
