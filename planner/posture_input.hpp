// A posture as a file (a query line of formats.md, here as a document with located errors): what commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stability/contact.hpp"
#include "terrain/document.hpp"

namespace surefoot::planner {

/// A file, "-" for stdin. A scene is refused, with a word on how the command takes those.
terrain::Document read_posture_document(const std::string& path, const char* for_scenes);
/// `contacts` of a posture: `least` to `most` of them.
std::vector<stability::Contact> read_contacts(const terrain::Node& root, std::size_t least, std::size_t most);
/// A coefficient of restitution, between 0 and 1; `place` is where it was given.
double checked_restitution(double e, const std::string& place);
double read_restitution(const terrain::Node& node);
/// [x, y]
Eigen::Vector2d read_point(const terrain::Node& node, const char* what);
/// A posture file of `surefoot region`.
struct DisturbedPosture {
  std::vector<stability::Contact> contacts;  ///< one to three
  std::optional<Eigen::Vector2d> com;
  double rho = 0;  ///< [m]
  stability::DisturbanceBox box;
  std::optional<double> restitution;
};
DisturbedPosture read_disturbed_posture(const terrain::Node& root);
/// "a,b,c" behind an option: `count` numbers as in scenes, whatever the locale.
std::vector<double> read_numbers(const std::string& option, const std::string& text, std::size_t count,
                                 const char* form);

}  // namespace surefoot::planner
