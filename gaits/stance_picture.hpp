// What pictures of one stance share: what they are about, the part of the plane they show, ground, contacts with their
// friction cones, lengths.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gaits/svg_canvas.hpp"
#include "stability/region.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

struct RegionFigure {
  std::string title;
  const terrain::Terrain* terrain = nullptr;  ///< none: a stroke of ground at each contact
  std::vector<stability::Contact> contacts;
  std::vector<std::string> contact_names;  ///< what stands beside each contact
  double radius_of_gyration = 0;
  stability::WrenchBox box;
  std::optional<Eigen::Vector2d> com;  ///< marked, if given
};

constexpr std::string_view ink = "#222", faint = "#666";

Eigen::AlignedBox2d bounds_of(const Polyline& points);

class StancePicture {
 public:
  /// Shows the contacts, the COM and `content` [m]; of a content much taller or wider than the stance the part near it.
  StancePicture(const RegionFigure& figure, const Eigen::AlignedBox2d& content, const Eigen::Vector2d& corner);

  const Eigen::AlignedBox2d& window() const { return window_; }
  const View& view() const { return view_; }
  /// Of the frame [px].
  Eigen::Vector2d size() const { return window_.sizes() * view_.scale; }

  void open_frame(SvgCanvas& canvas, std::string_view clip_id) const;
  void ground(SvgCanvas& canvas) const;   ///< below all else
  void surface(SvgCanvas& canvas) const;  ///< and what follows above the regions
  void contacts(SvgCanvas& canvas) const;
  void com(SvgCanvas& canvas) const;
  void close_frame(SvgCanvas& canvas) const;
  /// A scale and the lengths given, with their words, below the frame.
  void lengths(SvgCanvas& canvas, const std::vector<std::pair<double, std::string>>& shown) const;

 private:
  const RegionFigure& figure_;
  Eigen::Vector2d corner_;  ///< [px] of the frame, upper left
  Eigen::AlignedBox2d window_;
  View view_;
};

}  // namespace surefoot::gaits
