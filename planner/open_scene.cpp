#include <cstdio>

#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"

namespace surefoot::planner {

namespace {

constexpr const char* stdin_name = "<stdin>";

}  // namespace

std::string read_stdin() { return terrain::read_all(stdin, stdin_name); }

gaits::Scene open_scene(const std::string& path) {
  if (path == "-") return gaits::parse_scene(read_stdin(), stdin_name);
  return gaits::load_scene(scene_file(path));
}

std::optional<gaits::Scene> open_scene(const std::string& path, terrain::FaultList& faults) {
  try {
    if (path == "-") return gaits::parse_scene(read_stdin(), stdin_name, faults);
    return gaits::load_scene(scene_file(path), faults);
  } catch (const terrain::InputError& fault) {
    faults.add(fault);
    return std::nullopt;
  }
}

}  // namespace surefoot::planner
