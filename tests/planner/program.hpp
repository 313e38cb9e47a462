// Runs the built program on files of a temporary directory, as a user would.
#pragma once

#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace surefoot::tests {

namespace fs = std::filesystem;

/// A directory of its own, removed at the end.
class Workplace {
 public:
  Workplace() {
    std::string name = (fs::temp_directory_path() / "surefoot-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    root_ = name;
  }
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  std::string operator/(const std::string& name) const { return (root_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ / name, std::ios::binary) << text;
    return *this / name;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(root_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// How many entries there are, hidden ones too.
  std::ptrdiff_t count() const { return std::distance(fs::directory_iterator(root_), fs::directory_iterator()); }

  struct Outcome {
    int status = -1;  ///< exit status, 128 + n for signal n
    std::string out, err;
    bool one_error() const {
      return err.starts_with("surefoot: error: ") && err.ends_with("\n") && err.find('\n') == err.size() - 1;
    }
  };

  /// A piece of shell, run in the directory.
  Outcome shell(const std::string& commands, const std::string& input = "") const {
    const Workplace streams;
    streams.write("in", input);
    const std::string all = "cd '" + root_.string() + "' && { " + commands + "\n} <'" + (streams / "in") + "' >'" +
                            (streams / "out") + "' 2>'" + (streams / "err") + "'";
    const int raw = std::system(all.c_str());
    return {WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw), streams.read("out"), streams.read("err")};
  }
  /// The program with arguments as the shell reads them.
  Outcome run(const std::string& arguments, const std::string& input = "") const {
    return shell("'" SUREFOOT_BINARY "' " + arguments, input);
  }

 private:
  fs::path root_;
};

}  // namespace surefoot::tests
