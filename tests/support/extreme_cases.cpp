#include "tests/support/extreme_cases.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/exact_posture.hpp"

namespace surefoot::testing {
namespace {

using Eigen::Vector2d;

struct Base {
  std::string name;
  SamplePosture sample;
};

bool exactly_robust(const SamplePosture& sample) {
  const ExactPosture posture(sample);
  return posture.robust(posture.frame(ExactCom(sample.com)));
}
bool exactly_balanced(const SamplePosture& sample) {
  const ExactPosture posture(sample);
  return posture.equilibrium(posture.frame(ExactCom(sample.com)));
}

/// Of every kind, for two and three contacts, a robust posture and one that is not (as far as there are such).
std::vector<Base> ordinary_postures() {
  std::vector<Base> bases;
  Sampler sampler(1906);
  constexpr int attempts = 60;
  for (const Kind kind : all_kinds) {
    for (const int count : {2, 3}) {
      bool wanted[2] = {true, true};
      for (int k = 0; k < attempts && (wanted[0] || wanted[1]); ++k) {
        const SamplePosture sample = sampler.posture(kind, count);
        const bool robust = exactly_robust(sample);
        if (!wanted[robust]) continue;
        wanted[robust] = false;
        bases.push_back({std::string(name(kind)) + (robust ? " robust " : " ") + std::to_string(count), sample});
      }
    }
  }
  return bases;
}

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

/// Collects the cases of one group after another.
class Catalogue {
 public:
  Catalogue() : bases_(ordinary_postures()) {}
  std::vector<ExtremeCase> cases;

  void group(const std::string& name) { group_ = name; }
  void add(const std::string& name, const SamplePosture& sample) { cases.push_back({group_, name, sample}); }
  /// Applies a change to every `stride`-th ordinary posture.
  void vary(const std::string& what, std::size_t stride, const std::function<void(SamplePosture&)>& change) {
    for (std::size_t k = turn_++ % stride; k < bases_.size(); k += stride) {
      SamplePosture sample = bases_[k].sample;
      change(sample);
      add(bases_[k].name + ", " + what, sample);
    }
  }
  const std::vector<Base>& bases() const { return bases_; }

 private:
  std::vector<Base> bases_;
  std::string group_;
  std::size_t turn_ = 0;
};

void scale(SamplePosture& sample, double factor) {
  for (Contact& contact : sample.contacts) contact.position *= factor;
  sample.com *= factor;
  sample.rho *= factor;
  sample.box.nu *= factor;
}

double spread(const SamplePosture& sample) {
  double greatest = 0;
  for (const Contact& contact : sample.contacts)
    greatest = std::max(greatest, (contact.position - sample.contacts[0].position).norm());
  return greatest;
}

double moved_by_ulps(double value, int ulps) {
  const double towards = ulps > 0 ? HUGE_VAL : -HUGE_VAL;
  for (int k = 0; k < std::abs(ulps); ++k) value = std::nextafter(value, towards);
  return value;
}

void scales_and_shifts(Catalogue& all) {
  all.group("lengths times a power of two");
  for (const int exponent : {-30, -20, -10, 10, 20, 30})
    all.vary("lengths x 2^" + std::to_string(exponent), 2,
             [&](SamplePosture& s) { scale(s, std::ldexp(1.0, exponent)); });
  all.group("lengths times 1e-9 ... 1e9");
  for (const double factor : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9})
    all.vary("lengths x " + text(factor), 2, [&](SamplePosture& s) { scale(s, factor); });
  all.group("shifted by up to 1e8");
  for (const double by : {1e2, 1e4, 1e6, 1e8}) {
    all.vary("shifted by " + text(by), 2, [&](SamplePosture& s) {
      for (Contact& contact : s.contacts) contact.position += Vector2d(by, -0.7 * by);
      s.com += Vector2d(by, -0.7 * by);
    });
  }
}

void numbers_of_the_model(Catalogue& all) {
  all.group("friction 0 ... 1e9");
  for (const double mu : {0.0, 1e-12, 1e-6, 1.0, 1e3, 1e9}) {
    all.vary("all mu = " + text(mu), 3, [&](SamplePosture& s) {
      for (Contact& contact : s.contacts) contact.friction = mu;
    });
    all.vary("mu_1 = " + text(mu), 4, [&](SamplePosture& s) { s.contacts[0].friction = mu; });
  }
  all.group("kappa and nu 0 ... 10");
  for (const double kappa : {0.0, 1e-12, 1e-3, 1.0, 10.0})
    for (const double nu : {0.0, 1e-12, 1e-3, 1.0, 10.0})
      all.vary("kappa = " + text(kappa) + ", nu = " + text(nu), 5, [&](SamplePosture& s) { s.box = {kappa, nu}; });
  all.group("rho 1e-9 ... 1e6 of the contact distance");
  for (const double share : {1e-9, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6})
    all.vary("rho = " + text(share) + " d", 3, [&](SamplePosture& s) { s.rho = share * std::max(spread(s), 1e-3); });
}

void near_contacts(Catalogue& all) {
  all.group("contacts 0, 1e-300, 1e-9 apart");
  for (const double distance : {0.0, 1e-300, 1e-9}) {
    const auto gather = [&](SamplePosture& s) {
      for (std::size_t i = 1; i < s.contacts.size(); ++i)
        s.contacts[i].position = Vector2d(distance * static_cast<double>(i), 0);
      s.com -= s.contacts[0].position;
      s.contacts[0].position = Vector2d::Zero();
    };
    all.vary(text(distance) + " apart", 2, gather);
    all.vary(text(distance) + " apart, COM between", 2, [&](SamplePosture& s) {
      gather(s);
      s.com.x() = 0.5 * distance;
      s.box.nu = 0.1 * distance;
    });
    all.vary(text(distance) + " apart, COM and rho as near", 3, [&](SamplePosture& s) {
      gather(s);
      s.com = Vector2d(0.5 * distance, distance);
      s.rho = std::max(distance, 1e-9);
      s.box.nu = 0.1 * distance;
    });
    all.vary("third " + text(distance) + " from the first", 2,
             [&](SamplePosture& s) { s.contacts.back().position = s.contacts[0].position + Vector2d(distance, 0); });
  }
}

void directions(Catalogue& all) {
  all.group("normals parallel, or 1 ulp from it");
  for (const int ulps : {0, 1, -1}) {
    for (const bool sloped : {false, true}) {
      all.vary(std::to_string(ulps) + (sloped ? " ulp, slope" : " ulp, level"), 2, [&](SamplePosture& s) {
        const Vector2d normal = sloped ? Vector2d(-0.3, 0.9) : Vector2d(1e-16, 1);
        for (std::size_t i = 0; i < s.contacts.size(); ++i) {
          Contact& contact = s.contacts[i];
          if (sloped) contact.position.y() = contact.position.x() / 3;
          contact.normal = normal;
          if (i > 0) contact.normal.x() = moved_by_ulps(normal.x(), ulps);
        }
      });
    }
  }
  all.group("vertical and overhanging walls");
  for (const double lean : {0.0, 1e-17, -1e-17, 0.2, -0.2}) {
    for (const double mu : {0.3, 1.0, 3.0}) {
      all.vary("walls leaning " + text(lean) + ", mu = " + text(mu), 5, [&](SamplePosture& s) {
        for (std::size_t i = 0; i < s.contacts.size(); ++i) {
          s.contacts[i].normal = {i == 0 ? 1 : -1, lean};
          s.contacts[i].position.x() = i == 0 ? -0.5 : 0.5;
          s.contacts[i].friction = mu;
        }
        s.com.x() *= 0.4;
      });
    }
  }
  all.group("normals on one line");
  for (const double distance : {0.0, 0.25, 1.0}) {
    for (const bool facing : {false, true}) {
      for (const Vector2d& normal : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(0.6, 0.8), Vector2d(3, 1)}) {
        all.vary((facing ? "facing, " : "alike, ") + text(distance) + " n apart", 9, [&](SamplePosture& s) {
          s.contacts[0].normal = normal;
          s.contacts[1].position = s.contacts[0].position - (facing ? -1 : 1) * distance * normal;
          s.contacts[1].normal = facing ? Vector2d(-normal) : normal;
        });
      }
    }
  }
  all.group("a foot above a foot");
  for (const double height : {1e-9, 0.1, 1.0, 1e6}) {
    for (const double side : {0.0, std::numeric_limits<double>::denorm_min(), 1e-16}) {
      all.vary("second foot " + text(height) + " above, " + text(side) + " aside", 6, [&](SamplePosture& s) {
        s.contacts[0].normal = s.contacts[1].normal = {0, 1};
        s.contacts[0].position = {0, 0};
        s.contacts[1].position = {side, height};
      });
    }
  }
}

// ---- the COM on special places ----------------------------------------------------------------------------------

using Decide = std::function<bool(const SamplePosture&)>;

/// Two neighbouring doubles of one coordinate of the COM between which a verdict changes; false if none was found.
bool bisect(SamplePosture& sample, int axis, double far, const Decide& decide) {
  double near = sample.com[axis];
  const bool here = decide(sample);
  sample.com[axis] = far;
  if (decide(sample) == here) return false;
  for (int k = 0; k < 2000; ++k) {
    const double middle = near + (far - near) / 2;
    if (middle == near || middle == far) break;
    sample.com[axis] = middle;
    (decide(sample) == here ? near : far) = middle;
  }
  sample.com[axis] = near;
  return true;
}

void beside_boundaries(Catalogue& all, const std::string& label, std::size_t stride, const Decide& decide) {
  for (std::size_t k = 0; k < all.bases().size(); k += stride) {
    for (const int axis : {0, 1}) {
      for (const double far : {-3.0, 3.0}) {
        SamplePosture sample = all.bases()[k].sample;
        if (!bisect(sample, axis, sample.com[axis] + far, decide)) continue;
        const double found = sample.com[axis];
        for (const int ulps : {-4, -2, -1, 0, 1, 2, 4}) {
          sample.com[axis] = moved_by_ulps(found, ulps);
          all.add(all.bases()[k].name + ", " + label + (axis == 0 ? ", x " : ", y ") + std::to_string(ulps) + " ulp",
                  sample);
        }
      }
    }
  }
}

void special_places(Catalogue& all) {
  all.group("COM on a contact, or between two");
  all.vary("COM on the first", 1, [](SamplePosture& s) { s.com = s.contacts[0].position; });
  all.vary("COM 1 ulp from the first", 2, [](SamplePosture& s) {
    s.com = s.contacts[0].position;
    s.com.x() = moved_by_ulps(s.com.x(), 1);
  });
  all.vary("COM half way", 1, [](SamplePosture& s) { s.com = (s.contacts[0].position + s.contacts[1].position) / 2; });
  all.vary("COM above the first", 1, [](SamplePosture& s) { s.com.x() = s.contacts[0].position.x(); });
  all.group("COM on a facet +- 0, 1, 2, 4 ulp");
  beside_boundaries(all, "equilibrium", 2, exactly_balanced);
  all.group("COM on the edge of R(W) +- 0, 1, 2, 4 ulp");
  beside_boundaries(all, "robust", 1, exactly_robust);
  all.group("COM on a mode's boundary +- 0, 1, 2, 4 ulp");
  for (const std::size_t which : {0u, 1u, 2u, 4u, 7u, 9u}) {
    beside_boundaries(all, "mode " + std::to_string(which), 5, [which](const SamplePosture& sample) {
      const ExactPosture posture(sample);
      if (posture.modes().size() <= which) return false;
      return posture.feasible(posture.frame(ExactCom(sample.com)), posture.modes()[which]);
    });
  }
}

/// Small integers over powers of two: boundaries and D = 0 are met exactly.
SamplePosture lattice_posture(Sampler& sampler) {
  SamplePosture s;
  const int count = sampler.integer(2, 3);
  const auto coordinate = [&] { return 0.25 * sampler.integer(-6, 6); };
  for (int i = 0; i < count; ++i) {
    Contact contact;
    contact.position = {coordinate(), coordinate()};
    contact.normal = {static_cast<double>(sampler.integer(-2, 2)), static_cast<double>(sampler.integer(0, 2))};
    if (contact.normal.isZero()) contact.normal = {0, 1};
    contact.friction = 0.25 * sampler.integer(0, 8);
    s.contacts.push_back(contact);
  }
  s.com = {coordinate(), coordinate()};
  s.rho = std::ldexp(1.0, sampler.integer(-3, 0));
  s.box = {0.125 * sampler.integer(0, 4), 0.125 * sampler.integer(0, 4)};
  return s;
}

void exact_coincidences(Catalogue& all) {
  Sampler sampler(1908);
  all.group("on a boundary exactly (lattice)");
  for (int found = 0, k = 0; found < 150 && k < 20000; ++k) {
    const SamplePosture s = lattice_posture(sampler);
    // On a facet or on a mode's boundary: the verdict changes when the box grows by 2^-60.
    SamplePosture wider = s;
    wider.box.kappa *= 1 + 0x1p-50, wider.box.nu *= 1 + 0x1p-50;
    if (!exactly_balanced(s) || exactly_robust(s) == exactly_robust(wider)) continue;
    all.add("lattice " + std::to_string(k), s);
    ++found;
  }
  all.group("D = 0 and 1 ulp from it");
  for (int found = 0, k = 0; found < 60 && k < 20000; ++k) {
    SamplePosture s = lattice_posture(sampler);
    const ExactPosture posture(s);
    const ExactFrame frame = posture.frame(ExactCom(s.com));
    bool zero = false;
    for (const ExactMode& mode : posture.modes()) zero |= ExactPosture::denominator_sign(frame, mode) == 0;
    if (!zero) continue;
    ++found;
    all.add("lattice " + std::to_string(k), s);
    const double rho = s.rho;
    for (const int ulps : {-1, 1}) {
      s.rho = moved_by_ulps(rho, ulps);
      all.add("lattice " + std::to_string(k) + ", rho " + std::to_string(ulps) + " ulp", s);
    }
  }
}

void ends_of_the_range(Catalogue& all) {
  static constexpr double tiny = std::numeric_limits<double>::denorm_min(), small = std::numeric_limits<double>::min();
  all.group("denormals");
  all.vary("lengths x 2^-1060", 3, [](SamplePosture& s) {
    scale(s, 0x1p-1060);
    s.rho = std::max(s.rho, tiny);
  });
  all.vary("rho = 1e-308", 3, [](SamplePosture& s) { s.rho = 1e-308; });
  all.vary("rho denormal", 4, [](SamplePosture& s) { s.rho = tiny; });
  all.vary("mu denormal", 4, [](SamplePosture& s) {
    for (Contact& contact : s.contacts) contact.friction = tiny;
  });
  all.vary("normals denormal", 3, [](SamplePosture& s) {
    for (Contact& contact : s.contacts) contact.normal = {contact.normal.x() > 0 ? tiny : 0, 2 * tiny};
  });
  all.vary("box denormal", 4, [](SamplePosture& s) { s.box = {tiny, 3 * tiny}; });
  all.vary("COM denormally near a contact", 4, [](SamplePosture& s) {
    for (Contact& contact : s.contacts) contact.position -= s.contacts[0].position;
    s.com = {tiny, small};
  });
  all.group("near overflow");
  all.vary("lengths x 2^1000", 3, [](SamplePosture& s) { scale(s, 0x1p1000); });
  all.vary("lengths x 2^520", 3, [](SamplePosture& s) { scale(s, 0x1p520); });
  all.vary("mu = 1e300", 4, [](SamplePosture& s) {
    for (Contact& contact : s.contacts) contact.friction = 1e300;
  });
  all.vary("normals x 2^1020", 3, [](SamplePosture& s) {
    for (Contact& contact : s.contacts) contact.normal *= 0x1p1018;
  });
  all.vary("kappa = nu = 1e308", 4, [](SamplePosture& s) { s.box = {1e308, 1e308}; });
  all.vary("COM at 1e300", 4, [](SamplePosture& s) { s.com = {1e300, -1e300}; });
  all.vary("COM high above", 4, [](SamplePosture& s) { s.com.y() = 1e155; });
}

/// Several extremes at once.
void mixtures(Catalogue& all) {
  all.group("mixtures");
  Sampler sampler(1907);
  for (int round = 0; round < 5; ++round) {
    all.vary("mixture " + std::to_string(round), 1, [&](SamplePosture& s) {
      constexpr double frictions[]{0, 1e-12, 1e-6, 1, 1e3, 1e9}, boxes[]{0, 1e-12, 1e-3, 1, 10};
      for (Contact& contact : s.contacts)
        if (sampler.chance(0.3)) contact.friction = frictions[sampler.integer(0, 5)];
      if (sampler.chance(0.3)) s.box.kappa = boxes[sampler.integer(0, 4)];
      if (sampler.chance(0.3)) s.box.nu = boxes[sampler.integer(0, 4)];
      if (sampler.chance(0.4)) s.rho = std::pow(10.0, sampler.integer(-9, 6));
      if (sampler.chance(0.3)) s.contacts[1].normal = s.contacts[0].normal;
      if (sampler.chance(0.2)) s.contacts[1].position = s.contacts[0].position + Vector2d(1e-9, 0);
      if (sampler.chance(0.2)) s.com = s.contacts[1].position;
      if (sampler.chance(0.5)) scale(s, std::pow(10.0, sampler.integer(-9, 9)));
      if (sampler.chance(0.3)) s.com.y() += 1e6 * s.rho;
    });
  }
}

}  // namespace

std::vector<ExtremeCase> extreme_catalogue() {
  Catalogue all;
  scales_and_shifts(all);
  numbers_of_the_model(all);
  near_contacts(all);
  directions(all);
  special_places(all);
  exact_coincidences(all);
  ends_of_the_range(all);
  mixtures(all);
  return all.cases;
}

}  // namespace surefoot::testing
