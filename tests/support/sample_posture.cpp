#include "tests/support/sample_posture.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace surefoot::testing {
namespace {

constexpr double grid = 1.0 / 1024;  // [m] dyadic, so that sums and small products of grid points are exact
double snap(double value) { return std::round(value / grid) * grid; }

// The shortest text that reads back to the same double.
std::string shortest(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}
std::string pair(const Eigen::Vector2d& v) {
  return std::string("[").append(shortest(v.x())).append(", ").append(shortest(v.y())).append("]");
}

Eigen::Vector2d tilted(double angle) { return {std::sin(angle), std::cos(angle)}; }

std::vector<ContactMode> single_contact_modes(int count) {
  std::vector<ContactMode> modes;
  for (int i = 0; i < count; ++i) {
    for (ContactState state : {ContactState::rolls, ContactState::slides_along, ContactState::slides_against}) {
      ContactMode mode;
      mode.contacts = count;
      mode.at[i] = state;
      modes.push_back(mode);
    }
  }
  return modes;
}

}  // namespace

const char* name(Kind kind) {
  constexpr std::array<const char*, 13> names{"gentle",     "any",     "flat",        "vee",     "stairs",
                                              "ridge",      "walls",   "stacked",     "incline", "treads",
                                              "coincident", "opposed", "frictionless"};
  return names[static_cast<std::size_t>(kind)];
}

std::string SamplePosture::json() const {
  std::string text = "{\"contacts\": [";
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    text.append(i ? ", " : "").append("{\"p\": ").append(pair(contact.position));
    text.append(", \"n\": ").append(pair(contact.normal)).append(", \"mu\": ").append(shortest(contact.friction));
    text.append("}");
  }
  text.append("], \"com\": ").append(pair(com)).append(", \"rho\": ").append(shortest(rho));
  text.append(", \"kappa\": ").append(shortest(box.kappa)).append(", \"nu\": ").append(shortest(box.nu));
  return text.append("}");
}

double Sampler::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
}

int Sampler::integer(int low, int high) {
  return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
}

std::vector<Contact> Sampler::place(Kind kind, int count) {
  std::vector<Contact> contacts(count);
  std::vector<double> along(count);
  for (double& x : along) x = snap(uniform(-1, 1));
  std::sort(along.begin(), along.end());
  // A slope of small integers keeps x = origin + s direction and n exact.
  const Eigen::Vector2d direction(integer(2, 6), integer(-3, 3));
  const Eigen::Vector2d upward(-direction.y(), direction.x());
  for (int i = 0; i < count; ++i) {
    Contact& contact = contacts[i];
    const double side = count == 1 ? 0 : (along[i] < (along.front() + along.back()) / 2 ? -1 : 1);
    contact.position = {along[i], uniform(-0.3, 0.3)};
    contact.normal = tilted(uniform(-0.5, 0.5));
    switch (kind) {
      case Kind::gentle:
      case Kind::frictionless: break;
      case Kind::any: contact.normal = tilted(uniform(-3.15, 3.15)); break;
      case Kind::flat: contact.position.y() = 0, contact.normal = {0, 1}; break;
      case Kind::vee: contact.normal = tilted(-side * uniform(0.05, 1.2)); break;
      case Kind::ridge: contact.normal = tilted(side * uniform(0.05, 1.2)); break;
      case Kind::walls: contact.normal = tilted((chance(0.7) ? -side : side) * uniform(1.2, 1.9)); break;
      case Kind::stairs:
        contact.position.y() = 0.125 * integer(-3, 3);
        contact.normal = chance(0.75) ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(chance(0.5) ? 1 : -1, 0);
        break;
      case Kind::stacked:
        contact.position.y() = snap(contact.position.y());
        if (i == 1) {
          contact.position.x() = contacts[0].position.x();
          contact.normal = {0, chance(0.7) ? 1 : -1};
          if (chance(0.4)) contacts[0].normal = {0, 1};
        }
        break;
      case Kind::incline: contact.position = 0.25 * along[i] * direction, contact.normal = upward; break;
      case Kind::treads:
        contact.position = 0.25 * along[i] * direction + 0.0625 * integer(-3, 3) * upward;
        contact.normal = upward;
        break;
      case Kind::coincident:
        if (i > 0 && (i == 1 || chance(0.5))) contact.position = contacts[0].position;
        contact.normal = {snap(contact.normal.x()), snap(contact.normal.y())};
        if (i > 0 && chance(0.4)) contact.normal = contacts[0].normal;
        break;
      case Kind::opposed:
        if (i == 1) {
          contacts[0].position = {snap(contacts[0].position.x()), snap(contacts[0].position.y())};
          contacts[0].normal = chance(0.5) ? upward : Eigen::Vector2d(direction);
          contact.position = contacts[0].position + 0.125 * integer(-3, 3) * contacts[0].normal;
          contact.normal = (chance(0.5) ? 1 : -1) * contacts[0].normal;
        }
        break;
    }
  }
  return contacts;
}

Eigen::Vector2d Sampler::com_near(const std::vector<Contact>& contacts) {
  double low = contacts.front().position.x(), high = low;
  for (const Contact& contact : contacts) {
    low = std::min(low, contact.position.x());
    high = std::max(high, contact.position.x());
  }
  const double beyond = chance(0.6) ? 0 : 0.3 + 0.3 * (high - low);
  return {uniform(low - beyond, high + beyond), chance(0.8) ? uniform(0, 1) : uniform(-1, 2)};
}

SamplePosture Sampler::posture(Kind kind, int count) {
  if (count == 0) count = chance(0.1) ? 1 : chance(0.45) ? 2 : 3;
  SamplePosture sample;
  sample.kind = kind;
  const Kind shape = kind == Kind::frictionless ? all_kinds[integer(0, 11)] : kind;
  sample.contacts = place(shape, count);
  const bool sticky = chance(0.7);
  for (Contact& contact : sample.contacts) {
    contact.friction = kind == Kind::frictionless || chance(0.02) ? 0 : sticky ? uniform(0.3, 1.5) : uniform(0, 1.5);
    contact.normal *= std::ldexp(1.0, integer(-2, 2));  // a power of two keeps exact coincidences
    if (chance(0.3)) contact.normal *= integer(1, 7);
  }
  if (kind == Kind::coincident && count > 1 && chance(0.3)) sample.contacts[1] = sample.contacts[0];
  sample.com = com_near(sample.contacts);
  sample.rho = std::exp(uniform(std::log(0.01), std::log(1.0)));
  sample.box.kappa = chance(0.08) ? 0 : uniform(0, 0.3);
  sample.box.nu = chance(0.08) ? 0 : uniform(0, chance(0.5) ? 0.3 : 0.08);
  return sample;
}

std::vector<ContactMode> non_static_modes(int count) {
  std::vector<ContactMode> modes(1);
  modes[0].contacts = count;
  for (const ContactMode& mode : single_contact_modes(count)) modes.push_back(mode);
  constexpr std::array slides{ContactState::slides_along, ContactState::slides_against};
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      for (ContactState first : slides) {
        for (ContactState second : slides) {
          ContactMode mode = modes[0];
          mode.at[i] = first;
          mode.at[j] = second;
          modes.push_back(mode);
        }
      }
    }
  }
  return modes;
}

}  // namespace surefoot::testing
