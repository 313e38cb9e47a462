#include <fmt/format.h>

#include <cstdio>

#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"

namespace surefoot::planner {

namespace {

constexpr const char* stdin_name = "<stdin>";

}  // namespace

std::string read_stdin() { return terrain::read_all(stdin, stdin_name); }

/// Throws the first fault (of those kept, in the order of the file), with the number of the others.
gaits::Scene open_scene(const std::string& path) {
  terrain::FaultList faults;
  std::optional<gaits::Scene> scene = open_scene(path, faults);
  if (scene) return *std::move(scene);
  const terrain::InputError first = faults.kept().front();
  if (faults.count() == 1) throw terrain::InputError(first);
  const std::string place = path == "-" ? "" : " " + one_line(path);
  throw terrain::InputError(fmt::format("{} (and {} more: surefoot validate{})", first.what(), faults.count() - 1,
                                        place),
                            first.line, first.column);
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
