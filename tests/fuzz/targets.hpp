// What is fuzzed: readers of everything that comes from outside. Each target takes any bytes and returns; it throws
// Broken where a promise does not hold, and anything else that escapes (exceptions, crashes, hangs, leaks) is a defect
// too.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "terrain/document.hpp"

namespace surefoot::fuzz {

class Broken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// A scene is read, or refused with one located line; all faults at once contain the first one, and there are some
/// exactly if it is refused.
void scene(std::string_view bytes);
/// A plan is read, or refused with one located line; what is read is written as JSON and YAML and read back to the same
/// text; the verifier judges it without complaint, and it can be drawn whether it holds or not.
void plan(std::string_view bytes);
/// Each line of a query gets one line of JSON, an answer or an error with its number, and the same one every time.
void query(std::string_view bytes);
/// A posture file is read, or refused with one located line.
void posture(std::string_view bytes);
/// A posture file of `surefoot simulate` is read, or refused; the push that it tells of ends, the same way every time.
void simulate(std::string_view bytes);
/// A posture file of `surefoot region` is read, or refused; areas keep to their bounds, cells to the oracle's verdict.
void region(std::string_view bytes);

struct Target {
  std::string name;  ///< also of its folder in the corpus
  void (*run)(std::string_view);
};
const std::vector<Target>& targets();

/// `what` is a message for the user: one line that begins with the place "input:".
void expect_located(std::string_view what);

/// read(root) of the bytes as a document; nothing where it refuses them, with a place.
template <class Read>
auto read_located(std::string_view bytes, Read&& read)
    -> std::optional<std::invoke_result_t<Read, const terrain::Node&>> {
  try {
    return read(terrain::Document::parse(bytes, "input").root());
  } catch (const terrain::InputError& fault) {
    expect_located(fault.what());
    return std::nullopt;
  }
}
void expect(bool holds, const std::string& promise);

}  // namespace surefoot::fuzz
