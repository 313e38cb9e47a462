// Words and numbers for people about plans, shared by the table, the picture and whatever else explains a plan.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "gaits/plan.hpp"

namespace surefoot::gaits {

/// "stairs-up: 9 steps, safety factor 1.11", "gap: no plan found".
/// "... as stated" where the verifier refuses the plan.
std::string title_of(const Plan& plan, bool refused = false);

/// What a limit means: ("UF", {0, 2}) -> "foot 1 slides along +t while foot 3 breaks away". `legs` (0..2) are the
/// planted legs in increasing order, one per letter of a mode.
std::string limit_in_words(const std::string& limit, const std::vector<int>& legs);

/// Where the least safety factor of a plan is first met.
struct WeakestPlace {
  double sigma = 0;
  bool in_transfer = false;
  int index = -1;  ///< of the stance or transfer; -1 in a plan without stances
  std::string limit;
  bool bounded() const { return index >= 0 && !std::isinf(sigma); }  ///< it exists and limits something
};
WeakestPlace weakest_place(const Plan& plan);
/// "the transfer of step 3", "the last stance".
std::string place_in_words(const WeakestPlace& place, int steps);

/// A safety factor to three significant digits; one beside 1 does not read 1.00 ("<1.00", ">1.00"),
/// infinity reads "inf".
std::string factor_in_words(double sigma);

/// Digits of a length [m] after the point: millimetres for a robot of about a metre; in general at least a thousandth
/// of its reach.
int decimals_for(double reach);

/// Whether lengths [m] are told with that many decimals; those of tiny and of giant robots with six significant digits.
bool is_told_in_decimals(double reach);
std::string length_in_words(double length, double reach);

/// Legs (0..2) that stand, in increasing order.
std::vector<int> planted_legs(const Feet& feet);

}  // namespace surefoot::gaits
