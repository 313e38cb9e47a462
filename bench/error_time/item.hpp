// The parts of `surefoot bench`: items, each one computation that has an error, with the rows that it measures. An item
// is one file of this folder, and one line of the registry in registry.cpp.
#pragma once

#include <string>
#include <vector>

#include "bench/error_time/timing.hpp"

namespace surefoot::bench {

/// One point of a work-precision plot: one method at one accuracy level on one case.
struct Row {
  std::string scenario, method, parameter;  ///< scenario: column `case` of the table
  double error = 0;                         ///< infinite: no answer
  double low = 0, high = 0;                 ///< of the error, 95 % confidence; equal to it where there is none
  Timing time;
  std::string note;
};

class Rows {
 public:
  void add(std::string scenario, std::string method, std::string parameter, double error, Timing time,
           std::string note = {}) {
    rows_.push_back(
        {std::move(scenario), std::move(method), std::move(parameter), error, error, error, time, std::move(note)});
  }
  void add(Row row) { rows_.push_back(std::move(row)); }
  const std::vector<Row>& all() const { return rows_; }
  /// The first row of a case and a method (and a parameter, unless empty); none: null.
  const Row* find(const std::string& scenario, const std::string& method, const std::string& parameter = {}) const;

 private:
  std::vector<Row> rows_;
};

struct Item {
  const char* name;       ///< on the command line, of the files
  const char* what;       ///< one line
  const char* reference;  ///< what errors are against, and why it is independent of the methods
  const char* error;      ///< name and unit of the error axis
  const char* time;       ///< name of the time axis, without unit
  double time_unit;       ///< [s] that the axis counts in: 1e-6, 1e-3 or 1
  void (*measure)(Rows& rows, bool quick);
  /// What the rows say, in a few sentences of Markdown.
  std::string (*findings)(const Rows& rows);
  bool plotted = true;
};

/// "1e-6"
std::string power_of_ten(double value);

/// Every item, in the order of the page.
const std::vector<const Item*>& items();

}  // namespace surefoot::bench
