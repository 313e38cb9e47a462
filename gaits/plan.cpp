#include "gaits/plan.hpp"

namespace surefoot::gaits {

const char* to_string(Status status) {
  switch (status) {
    case Status::solved: return "solved";
    case Status::no_plan_found: return "no_plan_found";
    case Status::infeasible: return "infeasible";
  }
  return "";
}

Feet feet_during(const Stance& from, const Transfer& transfer) {
  Feet feet = from.feet;
  feet.at(static_cast<std::size_t>(transfer.leg)) = transfer.foothold;
  return feet;
}

}  // namespace surefoot::gaits
