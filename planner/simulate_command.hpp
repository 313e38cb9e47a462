// `surefoot simulate`: what a body on one or two contacts does after a push (stability/hybrid_dynamics.hpp), once with
// its events, or many times with random pushes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stability/hybrid_dynamics.hpp"

namespace surefoot::planner {

struct SimulateArguments {
  std::optional<std::string> posture;  ///< file, "-" for stdin; with `sample` both may be left out: random postures
  std::optional<std::string> scene, stance;  ///< instead: two start feet of a scene, LEG,LEG from 1
  std::optional<std::string> com, q, q_rate, heights, heights_rate;  ///< numbers between commas; override the file's
  std::optional<double> restitution, gravity, neighbourhood, time_limit;
  std::optional<std::string> svg, json;  ///< files; "-" is stdout, which then holds nothing else
  bool linearised = false;
  std::optional<std::int64_t> sample, seed;
  std::optional<double> size;  ///< of random pushes, relative to the extent of the posture
};

int run_simulate(const SimulateArguments& arguments);

/// A run with what the command says of it.
struct SimulateRecord {
  std::string title;
  double restitution = 0, neighbourhood = 0;
  stability::BodyState start;
  stability::HybridRun run;
  std::vector<stability::HybridEvent> events;  ///< the first of them
  std::uint64_t omitted = 0;
};
constexpr std::size_t most_events = 20000;  ///< kept of a run

std::string simulation_to_json(const stability::HybridBody& body, const SimulateRecord& record);
std::string simulation_to_text(const stability::HybridBody& body, const SimulateRecord& record);

/// What a command needs to draw random pushes.
struct SampleRequest {
  std::vector<stability::Contact> contacts;  ///< two, or none: drawn at random for every run
  std::optional<Eigen::Vector2d> com;        ///< none: drawn over the feet
  double rho = 0;
  stability::HybridOptions options;     ///< but for the neighbourhood
  std::optional<double> neighbourhood;  ///< [m]; none: a tenth of the extent of the posture
  double gravity = 0, size = 0;
  std::uint64_t runs = 0, seed = 1;
  std::function<void(std::uint64_t)> progress = [](std::uint64_t) {};  ///< told how many runs are done, after each

  stability::HybridOptions options_for(const stability::HybridBody& body) const {
    stability::HybridOptions result = options;
    result.neighbourhood = neighbourhood.value_or(0.1 * body.extent());
    return result;
  }
};
/// Shares of the runs that end at rest, by what Theorem 3 says of the posture [OR-H]: text, and JSON.
struct SampleReport {
  std::string text, json;
};
SampleReport sample_pushes(const SampleRequest& request);

}  // namespace surefoot::planner
