#include "planner/pushed_posture.hpp"

#include <fmt/format.h>

#include "planner/posture_input.hpp"

namespace surefoot::planner {

using stability::BodyState;
using stability::HybridBody;
using terrain::InputError;
using terrain::Node;

namespace {

std::optional<Eigen::Vector3d> triple(const Node& root, const char* key) {
  const Node* node = root.find(key);
  if (!node) return std::nullopt;
  const auto& items = node->items(key, 3);
  return Eigen::Vector3d(items[0].number(key), items[1].number(key), items[2].number(key));
}

}  // namespace

PushedPosture read_pushed_posture(const Node& root) {
  root.allow_only({"contacts", "com", "rho", "kappa", "nu", "restitution", "gravity", "q", "q_rate", "heights",
                   "heights_rate"},
                  "posture");
  PushedPosture posture;
  posture.contacts = read_contacts(root, 1, 2);
  posture.rho = root.require("rho", "posture").positive("rho");
  if (const Node* com = root.find("com")) posture.com = read_point(*com, "com");
  if (const Node* e = root.find("restitution")) posture.restitution = read_restitution(*e);
  if (const Node* g = root.find("gravity")) posture.gravity = g->positive("gravity");
  posture.push.q = triple(root, "q");
  posture.push.q_rate = triple(root, "q_rate");
  posture.push.heights = triple(root, "heights");
  posture.push.heights_rate = triple(root, "heights_rate");
  return posture;
}

BodyState start_of(const HybridBody& body, const Push& push) {
  const auto& [q, q_rate, heights, heights_rate] = push;
  if ((q || q_rate) && (heights || heights_rate))
    throw InputError("the start is given twice: expected q and q_rate, or heights and heights_rate");
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  BodyState state;
  if (heights || heights_rate) {
    if (body.parallel_normals())
      throw InputError(
          "heights: the normals of the contacts are parallel and leave the place open: give --q and --q-rate (in JSON "
          "q and q_rate)");
    state = body.state_at_heights(heights.value_or(zero), heights_rate.value_or(zero));
  } else {
    state = body.state_at(q.value_or(zero), q_rate.value_or(zero));
  }
  if (!is_finite(body, state)) throw InputError("the numbers of this start overflow");
  for (int i = 0; i < body.contacts(); ++i)
    if (!(state.h[static_cast<std::size_t>(i)] >= 0))
      throw InputError(fmt::format("contact {} starts {:.6g} m below the ground, expected a height >= 0", i + 1,
                                   -state.h[static_cast<std::size_t>(i)]));
  return state;
}

}  // namespace surefoot::planner
