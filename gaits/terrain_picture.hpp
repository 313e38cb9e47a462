// Draws terrain into an SVG canvas: solid ground filled where it is clear which side is solid, hatched where chains
// nest; the surface by what it offers to a foot. For every picture of a scene.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "gaits/plan.hpp"
#include "gaits/svg_canvas.hpp"
#include "stability/contact.hpp"
#include "terrain/terrain.hpp"

namespace surefoot::gaits {

class TerrainPicture {
 public:
  /// Keeps a reference to the terrain.
  explicit TerrainPicture(const terrain::Terrain& terrain);

  /// The solid side; `window` [m] is what the picture shows.
  void draw_ground(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window) const;
  /// The surface as strokes: friction by colour, no foothold by dashes.
  void draw_surface(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window) const;

  enum class Grip { usual, less, more };  ///< than most of the terrain
  /// A stretch of like surface along a chain.
  struct Run {
    Grip grip = Grip::usual;
    bool foothold = true;
    bool hatched = false;  ///< its chain has no solid side that could be filled
    Polyline points;       ///< [m]
  };
  /// What the pictures are made of, in metres: the solid side, cut at the window, and every stretch of surface that may
  /// show in it.
  std::vector<Polyline> ground_in(const Eigen::AlignedBox2d& window) const;
  std::vector<Run> surface_in(const Eigen::AlignedBox2d& window) const;
  /// "friction 0.2 to 0.4"; empty if the terrain has no such grip.
  std::string friction_range(Grip grip) const;

  struct Key {
    Paint paint;
    std::optional<Paint> overlay;
    std::string label;
    std::optional<Paint> hatching = {};  ///< on its lower side
  };
  /// What the strokes mean, as far as this terrain uses them.
  std::vector<Key> legend() const;

  /// Segment of a foothold, nullptr if the terrain has none such.
  const terrain::Segment* segment_of(const terrain::Foothold& foot) const;
  /// Planted feet as contacts with the terrain's surface, in the order of the legs; none if one of them stands on no
  /// segment of it (a plan of another scene).
  std::vector<stability::Contact> contacts_of(const Feet& feet) const;

 private:
  Grip grip(const terrain::Segment& segment) const;
  /// Whether another chain, hence free space, lies in what a chain is taken to bound.
  bool has_others_inside(const Polyline& solid, std::size_t chain) const;
  void hatch(SvgCanvas& canvas, const View& view, const Eigen::AlignedBox2d& window, int chain) const;

  const terrain::Terrain& terrain_;
  std::vector<Polyline> chains_;  ///< vertices
  std::vector<std::size_t> chain_begin_;
  std::vector<Polyline> solids_;  ///< one per chain; empty: to be hatched
  double usual_friction_ = 0;     ///< of the greatest length of terrain
};

}  // namespace surefoot::gaits
