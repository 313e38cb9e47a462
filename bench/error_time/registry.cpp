#include <fmt/format.h>

#include <cmath>

#include "bench/error_time/items.hpp"

namespace surefoot::bench {

const Row* Rows::find(const std::string& scenario, const std::string& method, const std::string& parameter) const {
  for (const Row& row : rows_)
    if (row.scenario == scenario && row.method == method && (parameter.empty() || row.parameter == parameter))
      return &row;
  return nullptr;
}

std::string power_of_ten(double value) { return fmt::format("1e{}", std::lround(std::log10(value))); }

const std::vector<const Item*>& items() {
  static const std::vector<const Item*> all{&verdict_item,    &factor_item,   &line_item,    &region_item, &hybrid_item,
                                            &refinement_item, &planners_item, &pruning_item, &targets_item};
  return all;
}

}  // namespace surefoot::bench
