#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"
#include "planner/console.hpp"

namespace surefoot::planner {

namespace {

constexpr const char* stdin_name = "<stdin>";

/// A file that takes a second to read is named while it is read.
void tell_large(const std::string& file) {
  constexpr std::uintmax_t large = 3'000'000;  // [bytes] some 200,000 vertices
  std::error_code fault;
  const std::uintmax_t size = std::filesystem::file_size(file, fault);
  if (!fault && size > large) show_progress(fmt::format("reading {} ({} MB) ...", file, size / 1'000'000));
}

}  // namespace

std::string read_stdin() { return terrain::read_all(stdin, stdin_name); }

/// Throws the first fault (of those kept, in the order of the file), with the number of the others.
gaits::Scene open_scene(const std::string& path, bool quiet) {
  terrain::FaultList faults;
  std::optional<gaits::Scene> scene = open_scene(path, faults, quiet);
  if (scene) return *std::move(scene);
  const terrain::InputError first = faults.kept().front();
  if (faults.count() == 1) throw terrain::InputError(first);
  const std::string place = path == "-" ? "" : " " + one_line(path);
  throw terrain::InputError(fmt::format("{} (and {} more: surefoot validate{})", first.what(), faults.count() - 1,
                                        place),
                            first.line, first.column);
}

std::optional<gaits::Scene> open_scene(const std::string& path, terrain::FaultList& faults, bool quiet) {
  try {
    if (path == "-") return gaits::parse_scene(read_stdin(), stdin_name, faults);
    const std::string file = scene_file(path);
    if (!quiet) tell_large(file);
    auto scene = gaits::load_scene(file, faults);
    show_progress("");
    return scene;
  } catch (const terrain::InputError& fault) {
    faults.add(fault);
    return std::nullopt;
  }
}

}  // namespace surefoot::planner
