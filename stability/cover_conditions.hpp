// The two conditions (*) of dual_certificate.hpp on an interval of a straight line of COMs, for a covector Z
// interpolated between za and zb. `moment` holds the Bernstein coefficients (degree 2) of Z's moment about the COM.
// Times rho^2 throughout.
#pragma once

#include <array>

#include "stability/planar.hpp"

namespace surefoot::stability {

/// nu |moment| + slack < rho^2 (Z_y - kappa |Z_x|): Z . M^-1 v > 0 at the four corners of W.
template <class K>
bool positive_on_corners_at(const Row<K>& z, const K& moment, const K& rho2, const DisturbanceBox& box,
                            const K& slack) {
  const auto absolute = [](const K& k) -> K { return k < 0 ? K(-k) : k; };
  return K(box.nu) * absolute(moment) + slack < rho2 * (z.one - K(box.kappa) * absolute(z.p));
}

/// rho^2 Z . C + moment s_z + slack < 0: the force along C reads negative.
template <class K>
bool negative_on_edge_at(const Row<K>& z, const K& moment, const Vec2<K>& c, const K& s, const K& rho2,
                         const K& slack) {
  return rho2 * (z.p * c.x + z.one * c.y) + moment * s + slack < 0;
}

/// nu |moment| < rho^2 (Z_y - kappa |Z_x|) on the whole interval: Bernstein coefficients of degree 2; the right side is
/// concave in Z, hence at least its linear interpolation.
template <class K>
bool positive_on_corners(const Row<K>& za, const Row<K>& zb, const std::array<K, 3>& moment, const K& rho2,
                         const DisturbanceBox& box, const K& slack) {
  const auto absolute = [](const K& k) -> K { return k < 0 ? K(-k) : k; };
  const auto rest = [&](const Row<K>& z) -> K { return rho2 * (z.one - K(box.kappa) * absolute(z.p)); };
  const K ra = rest(za), rb = rest(zb), nu(box.nu), two(2);
  return nu * absolute(moment[0]) + slack < ra && nu * two * absolute(moment[1]) + two * slack < ra + rb &&
         nu * absolute(moment[2]) + slack < rb;
}

/// rho^2 Z . C + moment s_z < 0 on the whole interval: Bernstein coefficients of degree 3, times 3.
template <class K>
bool negative_on_edge(const Row<K>& za, const Row<K>& zb, const std::array<K, 3>& moment, const Vec2<K>& c, const K& sa,
                      const K& sb, const K& rho2, const K& slack) {
  const K la = rho2 * (za.p * c.x + za.one * c.y), lb = rho2 * (zb.p * c.x + zb.one * c.y);
  const K two(2), three(3);
  return la + moment[0] * sa + slack < 0 && lb + moment[2] * sb + slack < 0 &&
         two * la + lb + moment[0] * sb + two * moment[1] * sa + three * slack < 0 &&
         la + two * lb + two * moment[1] * sb + moment[2] * sa + three * slack < 0;
}

/// Z's moment about the COM at offset r from the point about which z.q is given.
template <class K>
K moment_about_com(const Row<K>& z, const Vec2<K>& r) {
  return z.q + r.x * z.one - r.y * z.p;
}

}  // namespace surefoot::stability
