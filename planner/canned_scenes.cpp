#include "planner/canned_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "planner/commands.hpp"
#include "planner/console.hpp"
#include "terrain/document.hpp"

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

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

std::string first_comment(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line.substr(std::min(line.find_first_not_of("# "), line.size()));
}

/// The canned scene of that name, as a path; "" if there is none.
std::string canned_file(const std::vector<CannedScene>& canned, const std::string& name) {
  const auto found = std::find_if(canned.begin(), canned.end(), [&](const CannedScene& c) { return c.name == name; });
  return found == canned.end() ? "" : found->file;
}

/// "stairs_down or stairs_up" for "stairs"; "" if no canned scene begins so, or too many do.
std::string begun_with(const std::string& word, const std::vector<CannedScene>& canned) {
  constexpr std::size_t least_letters = 3, most = 4;
  std::vector<std::string> names;
  for (const CannedScene& scene : canned)
    if (word.size() >= least_letters && scene.name.starts_with(word)) names.push_back(scene.name);
  return names.size() > most ? "" : fmt::format("{}", fmt::join(names, " or "));
}

/// What a path that leads nowhere may have meant, as it would have to be given: a scene in the same directory, one in
/// maps/, or a canned one; of equal stem, else of the nearest. "" if there is none.
std::string scene_meant(const fs::path& path, const std::vector<CannedScene>& canned) {
  const fs::path beside = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  std::vector<std::string> scenes = scenes_in(beside), stems;
  const std::vector<std::string> in_maps = scenes_in("maps");
  scenes.insert(scenes.end(), in_maps.begin(), in_maps.end());
  for (const std::string& scene : scenes) stems.push_back(stem_of(scene));
  for (const CannedScene& scene : canned) {
    scenes.push_back(scene.name);
    stems.push_back(scene.name);
  }
  const std::string stem = path.extension() == ".yaml" ? path.stem().string() : path.filename().string();
  auto found = std::find(stems.begin(), stems.end(), stem);
  if (found == stems.end()) {
    const std::string near = terrain::near_miss(stem, stems);
    found = near.empty() ? stems.end() : std::find(stems.begin(), stems.end(), near);
  }
  if (found == stems.end()) return begun_with(stem, canned);
  return fs::path(scenes[static_cast<std::size_t>(found - stems.begin())]).lexically_normal();
}

}  // namespace

std::vector<CannedScene> canned_scenes() {
  std::error_code fault;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  const fs::path maps = fs::canonical(program.parent_path() / "../share/surefoot/maps", fault);
  std::vector<CannedScene> scenes;
  if (fault) return scenes;
  for (const std::string& file : scenes_in(maps)) scenes.push_back({stem_of(file), file, first_comment(file)});
  std::stable_partition(scenes.begin(), scenes.end(),
                        [](const CannedScene& scene) { return !scene.purpose.starts_with("Impossible"); });
  return scenes;
}

std::string scene_file(const std::string& scene) {
  std::error_code ignored;
  const bool exists = fs::exists(scene, ignored), directory = fs::is_directory(scene, ignored);
  if (scene.empty() || scene == "-" || (exists && !directory)) return scene;
  const std::vector<CannedScene> canned = canned_scenes();
  if (std::string file = canned_file(canned, scene); !file.empty()) return file;
  if (exists) return scene;
  if (fs::is_symlink(scene, ignored))
    throw terrain::InputError(fmt::format("{}: is a symbolic link that leads nowhere", one_line(scene)));
  const std::string meant = scene_meant(scene, canned);
  throw terrain::InputError(
      fmt::format("{}: no such file or canned scene{}", one_line(scene),
                  meant.empty() ? " (surefoot maps lists those)" : fmt::format(", did you mean {}?", meant)));
}

int run_maps() {
  const std::vector<CannedScene> scenes = canned_scenes();
  if (scenes.empty())
    throw terrain::InputError("no canned scenes: expected in ../share/surefoot/maps beside the program");
  std::size_t width = 0;
  for (const CannedScene& scene : scenes) width = std::max(width, scene.name.size());
  std::string text;
  for (const CannedScene& scene : scenes)
    fmt::format_to(std::back_inserter(text), "{:<{}}  {}\n", scene.name, width, scene.purpose);
  write_stdout(text);
  return exit_success;
}

}  // namespace surefoot::planner
