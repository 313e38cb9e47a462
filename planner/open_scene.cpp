#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "planner/commands.hpp"

namespace surefoot::planner {

namespace fs = std::filesystem;

namespace {

/// Scenes in a directory, as paths.
std::vector<std::string> scenes_in(const fs::path& directory) {
  std::vector<std::string> found;
  std::error_code fault;
  for (fs::directory_iterator entry(directory, fault), end; !fault && entry != end; entry.increment(fault))
    if (entry->path().extension() == ".yaml") found.push_back((directory / entry->path().filename()).string());
  std::sort(found.begin(), found.end());
  return found;
}

/// The scene that a path which leads nowhere may have meant: in the same directory or in maps/; "" if none.
std::string scene_meant(const fs::path& path) {
  const std::string stem = path.extension() == ".yaml" ? path.stem().string() : path.filename().string();
  const fs::path beside = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  for (const fs::path& directory : {beside, fs::path("maps")}) {
    const std::vector<std::string> scenes = scenes_in(directory);
    std::vector<std::string> stems;
    for (const std::string& scene : scenes) stems.push_back(fs::path(scene).stem().string());
    auto found = std::find(stems.begin(), stems.end(), stem);
    if (found == stems.end()) {
      const std::string near = terrain::near_miss(stem, stems);
      found = near.empty() ? stems.end() : std::find(stems.begin(), stems.end(), near);
    }
    if (found != stems.end())
      return fs::path(scenes[static_cast<std::size_t>(found - stems.begin())]).lexically_normal();
  }
  return {};
}

/// For a path that leads nowhere: says what may have been meant.
void check_exists(const fs::path& path) {
  std::error_code ignored;
  if (path.empty() || fs::exists(path, ignored)) return;
  const std::string meant = scene_meant(path);
  if (meant.empty()) return;
  throw terrain::InputError(fmt::format("{}: no such file, did you mean {}?", path.string(), meant));
}

constexpr const char* stdin_name = "<stdin>";

}  // namespace

std::string read_stdin() { return terrain::read_all(stdin, stdin_name); }

gaits::Scene open_scene(const std::string& path) {
  if (path == "-") return gaits::parse_scene(read_stdin(), stdin_name);
  check_exists(path);
  return gaits::load_scene(path);
}

std::optional<gaits::Scene> open_scene(const std::string& path, terrain::FaultList& faults) {
  try {
    if (path == "-") return gaits::parse_scene(read_stdin(), stdin_name, faults);
    check_exists(path);
    return gaits::load_scene(path, faults);
  } catch (const terrain::InputError& fault) {
    faults.add(fault);
    return std::nullopt;
  }
}

}  // namespace surefoot::planner
