#include "stability/region_setup.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::stability {
namespace {

using Eigen::Vector2d;

Vector2d middle_of(std::span<const Contact> contacts) {
  Vector2d sum = Vector2d::Zero();
  for (const Contact& contact : contacts) sum += contact.position - contacts[0].position;
  return contacts[0].position + sum / static_cast<double>(contacts.size());
}

double core_of(std::span<const Contact> contacts, double rho) {
  double extent = 0;
  for (const Contact& contact : contacts) extent = std::max(extent, (contact.position - contacts[0].position).norm());
  return extent + rho;
}

}  // namespace

RegionSetup::RegionSetup(std::span<const Contact> contacts, double rho, const WrenchBox& box,
                         const RegionOptions& options)
    : posture(contacts, rho), core(core_of(contacts, rho)) {
  const std::vector<LabelledHalfPlane> planes = equilibrium_half_planes(posture, box);
  polygon = equilibrium_polygon(planes, contacts, rho, options, window);
  const double found = polygon.corner.size() < 3 ? 0 : area_of(polygon.corner);
  if (!(found > 0)) {
    problem = "no COM can be balanced under every wrench of W";
    return;
  }
  if (!std::isfinite(found)) {
    problem = "the numbers of this posture overflow";
    return;
  }
  area = found;
  modes = std::make_unique<RegionModes>(posture, box, middle_of(contacts), line_direction(contacts, planes));
  for (const Vector2d& corner : polygon.corner) local.push_back(modes->local(corner));
  std::vector<Poly2> edges;
  for (std::size_t k = 0; k < local.size(); ++k) {
    const Vector2d a = local[k], d = local[(k + 1) % local.size()] - a;
    edges.push_back(Poly2(d.y() * a.x() - d.x() * a.y(), -d.y(), d.x()));
  }
  modes->set_edges(std::move(edges));
}

}  // namespace surefoot::stability
