// Runs the built program on files of a temporary directory, as a user would.
#pragma once

#include <catch2/catch.hpp>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/run_program.hpp"

namespace surefoot::tests {

namespace fs = std::filesystem;

/// A directory of its own, removed at the end.
class Workplace {
 public:
  std::string operator/(const std::string& name) const { return folder_.file(name); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
    return *this / name;
  }
  /// Empty if there is no such file.
  std::string read(const std::string& name) const {
    std::ifstream in(*this / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// How many entries there are, hidden ones too.
  std::ptrdiff_t count() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  struct Outcome : test::ProgramRun {
    bool one_error() const {
      return err.starts_with("surefoot: error: ") && err.ends_with("\n") && err.find('\n') == err.size() - 1;
    }
  };

  /// A piece of shell, run in the directory.
  Outcome shell(const std::string& commands, const std::string& input = "") const {
    const std::string all = "cd '" + folder_.path().string() + "' && { " + commands + "\n}";
    return {test::run_program("/bin/sh", {"-c", all}, input)};
  }
  /// The program with arguments as the shell reads them.
  Outcome run(const std::string& arguments, const std::string& input = "") const {
    return shell("'" SUREFOOT_BINARY "' " + arguments, input);
  }

 private:
  test::ScratchFolder folder_;
};

/// plan.json and plan.svg, which held "precious", are neither written nor is anything left beside.
inline void check_untouched(const Workplace& place, std::ptrdiff_t files) {
  CHECK(place.read("plan.json") == "precious");
  CHECK(place.read("plan.svg") == "precious");
  CHECK(place.count() == files);
}

}  // namespace surefoot::tests
