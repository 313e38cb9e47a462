// The picture of the regions of frictional stability, in the manner of [OR-H, Fig. 3]: the strip R_EQ, the
// kinematic-strong region shaded, the clattering region hatched, where both hold outlined; a key with areas.
#pragma once

#include "gaits/stance_picture.hpp"
#include "stability/frictional_region.hpp"

namespace surefoot::gaits {

class FrictionalPanel {
 public:
  /// `corner` [px] is the upper left one. Keeps references to both.
  FrictionalPanel(const RegionFigure& figure, const stability::FrictionalRegion& region, const Eigen::Vector2d& corner);

  Eigen::Vector2d size() const;  ///< [px] with the key
  void draw(SvgCanvas& canvas) const;

 private:
  void heading(SvgCanvas& canvas) const;
  void parts(SvgCanvas& canvas) const;
  void key(SvgCanvas& canvas) const;

  const RegionFigure& figure_;
  const stability::FrictionalRegion& region_;
  Eigen::Vector2d corner_;
  StancePicture stance_;
};

}  // namespace surefoot::gaits
