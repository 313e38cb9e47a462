// Plans as text and pictures for people, as JSON and YAML for programs (formats.md), and reading them back.
// Guarantee: the same scene and plan give the same bytes, whatever the locale (time_s is the only value of a plan that
// varies from run to run; the picture leaves it out); what to_json and to_yaml write, parse_plan reads back to the same
// doubles and strings. Nothing here judges a plan: that is the verifier's work.
#pragma once

#include <string>
#include <string_view>

#include "gaits/plan.hpp"
#include "gaits/scene.hpp"
#include "terrain/document.hpp"

namespace surefoot::gaits {

struct TextOptions {
  bool colour = false;   ///< ANSI colours
  bool explain = false;  ///< spell out what limits each stance and transfer
};

/// A table of steps with a summary. Safety factors have three significant digits, lengths at least a thousandth of the
/// reach.
std::string to_text(const Scene& scene, const Plan& plan, const TextOptions& options = {});

/// What `explain` adds to the table: how far was searched, what limits each step, what was left out.
std::string explanation(const Scene& scene, const Plan& plan);

/// One line per stance and transfer; numbers in their shortest form that reads back to the same double. Legs are 1..3.
/// Bytes that are not UTF-8 become U+FFFD. Throws std::invalid_argument if a number is not finite (safety factors may
/// be infinite: "inf").
std::string to_json(const Plan& plan);
std::string to_yaml(const Plan& plan);  ///< the same tree, valid for readers of YAML 1.1 and 1.2

/// A self-contained drawing without scripts: terrain, feet, legs, COM path, R_SS(W) of each stance within reach. Long
/// journeys are broken into rows like the lines of a page. `faults`: what the verifier has against the plan, one line
/// each; the heading says so.
std::string to_svg(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults = {});

/// The scene alone in the same style: terrain, start feet, goal.
std::string to_svg(const Scene& scene);

/// A self-contained page that plays the gait in a browser, without network: each step with the motion that the rules
/// check (lift-off, turn of the shortened leg about the COM, touch-down, COM on its line), the region of COMs that
/// hold, the safety factor and what limits it. The plan is in it as to_json writes it, without time_s. `faults`: what
/// the verifier has against the plan, one line each. Throws std::invalid_argument as to_json.
std::string to_html(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults = {});

/// Reads JSON or YAML (JSON is YAML). Throws terrain::InputError with file:line:column. Positions are taken as written;
/// whether they lie on the scene's terrain, and whether the steps make a gait, is for the verifier to say. Where a
/// foothold gives no `normal` or `friction` (both are optional and derive from the terrain), Foothold's defaults stand.
Plan read_plan(const std::string& path);
Plan parse_plan(std::string_view text, const std::string& name);

}  // namespace surefoot::gaits
