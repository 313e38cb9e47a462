// The scenes that come with the program, known by their names: ../share/surefoot/maps beside the folder of the
// executable (in a build tree a link to maps/). A program that was moved away from them has none.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace surefoot::planner {

struct CannedScene {
  std::string name;     ///< as given to commands
  std::string file;     ///< its path
  std::string purpose;  ///< its first line, without the comment sign
};

/// By name; those that need a plan to be found before the impossible ones.
std::vector<CannedScene> canned_scenes();

/// The file that a command's SCENE means: the file of that name or, where there is none, the canned scene; "-" stays
/// "-". Throws terrain::InputError, with what may have been meant, where it is neither.
std::string scene_file(const std::string& scene);

}  // namespace surefoot::planner
