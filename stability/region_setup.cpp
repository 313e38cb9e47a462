#include "stability/region_setup.hpp"

#include <algorithm>
#include <cmath>

#include "stability/given.hpp"

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

std::span<const Contact> sound(std::span<const Contact> contacts, double rho, const WrenchBox& box,
                               const RegionOptions& options) {
  require_contacts(contacts);
  require_radius_of_gyration(rho);
  require(not_negative(box.kappa) && not_negative(box.nu) && std::isfinite(box.centre.p) && std::isfinite(box.centre.q),
          "wrenches: expected finite numbers, kappa and nu >= 0");
  require(positive(options.area_tolerance) && positive(options.curve_tolerance),
          "region: expected tolerances to be numbers > 0");
  require_window(options.window);
  return contacts;
}

}  // namespace

void require_window(const std::optional<Eigen::AlignedBox2d>& window) {
  if (!window) return;
  require(window->min().allFinite() && window->max().allFinite() && (window->sizes().array() > 0).all(),
          "window: expected finite corners, the least below the greatest");
}

RegionSetup::RegionSetup(std::span<const Contact> contacts, double rho, const WrenchBox& box,
                         const RegionOptions& options)
    : posture(sound(contacts, rho, box, options), rho), core(core_of(contacts, rho)) {
  const std::vector<LabelledHalfPlane> planes = equilibrium_half_planes(posture, box);
  polygon = equilibrium_polygon(planes, contacts, rho, options, window);
  const double found = polygon.corner.size() < 3 ? 0 : area_of(polygon.corner);
  if (!(found > 0)) {
    problem = "no COM ";
    if (options.window) problem += "in the window ";
    problem += box.one_wrench() ? "can be balanced under this wrench" : "can be balanced under every wrench of W";
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
