#include <cmath>
#include <optional>

#include "planner/pushed_posture.hpp"
#include "stability/hybrid_dynamics.hpp"
#include "tests/fuzz/targets.hpp"

namespace surefoot::fuzz {

namespace {

using stability::HybridBody;
using stability::HybridRun;

std::optional<stability::BodyState> start(const HybridBody& body, const planner::Push& push) {
  try {
    return planner::start_of(body, push);
  } catch (const terrain::InputError&) {  // has no place: it is about the whole posture
    return std::nullopt;
  }
}

HybridRun judged_run(const HybridBody& body, const stability::BodyState& from,
                     const stability::HybridOptions& options) {
  double last = 0;
  const HybridRun run = stability::simulate(body, from, options, [&](const stability::HybridEvent& event) {
    expect(event.time >= last, "time does not run back");
    expect(event.contact >= 0 && event.contact < body.contacts(), "an event is at a contact");
    last = event.time;
  });
  expect(run.time >= last, "nothing happens after the end");
  if (run.outcome == HybridRun::Outcome::rest)
    expect(run.state.v.isZero(0) && run.state.omega == 0, "what is at rest stands still");
  return run;
}

}  // namespace

void simulate(std::string_view bytes) {
  const auto posture = read_located(bytes, planner::read_pushed_posture);
  if (!posture) return;
  const HybridBody body(posture->contacts, posture->com.value_or(Eigen::Vector2d::Zero()), posture->rho,
                        posture->gravity.value_or(9.81));
  const auto from = start(body, posture->push);
  if (!from) return;
  stability::HybridOptions options;
  options.restitution = posture->restitution.value_or(options.restitution);
  options.neighbourhood = 0.1 * body.extent();
  options.time_limit = 10;
  options.most_collisions = 3000;
  const HybridRun run = judged_run(body, *from, options);
  if (run.outcome == HybridRun::Outcome::undecided) return;  // has been long enough
  const HybridRun again = judged_run(body, *from, options);
  expect(run.outcome == again.outcome && run.collisions == again.collisions, "the same push ends the same way");
}

}  // namespace surefoot::fuzz
