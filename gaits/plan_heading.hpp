// Title, scale and legend of the picture of a plan, and the paints that the legend explains.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "gaits/plan_page.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/svg_canvas.hpp"
#include "gaits/terrain_picture.hpp"

namespace surefoot::gaits {

// Okabe and Ito's palette, told apart by colour-blind eyes.
constexpr std::array<std::string_view, leg_count> leg_colour{"#0072b2", "#d55e00", "#009e73"};
constexpr std::string_view support_colour = "#cc79a7", goal_colour = "#f0e442", weak_colour = "#e69f00", ink = "#222",
                           faint = "#666", alarm = "#c00";
constexpr Paint support_edge{.stroke = support_colour, .width = 0.8, .opacity = 0.45};
constexpr Paint com_line{.stroke = ink, .width = 1.6};
constexpr Paint com_dot{.fill = "#fff", .stroke = ink, .width = 1.4};
constexpr Paint weak_line{.stroke = weak_colour, .width = 7};
constexpr double dot_radius = 3.2, badge_radius = 6.5;  // [px]
constexpr double ring_radius = dot_radius + 4;          // [px] about the weakest waypoint
constexpr double heading_height = 116;                  // [px] what the page leaves free for it

/// The number of a leg in a disk.
void draw_badge(SvgCanvas& canvas, const Eigen::Vector2d& at, int leg);

/// `faults`: the verifier's, of a plan that it refuses.
void draw_heading(SvgCanvas& canvas, const Page& page, const std::string& title, const Plan& plan,
                  const std::vector<std::string>& faults, const WeakestPlace& weakest, const TerrainPicture& terrain);

}  // namespace surefoot::gaits
