// Runs a program as a user would and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::test {

/// A folder of its own that goes away with the object.
class ScratchFolder {
 public:
  ScratchFolder();  ///< throws std::runtime_error if it cannot be made
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

struct ProgramRun {
  int status = -1;       ///< exit status; 128 + signal number if a signal ended it
  std::string out, err;  ///< all of standard output and standard error
};

/// `arguments` go to the program as they are; standard input is `input`. Throws std::runtime_error if it cannot be run.
ProgramRun run_program(const std::string& program, const std::vector<std::string>& arguments,
                       const std::string& input = {});

/// The whole text of a file. Throws std::runtime_error if it cannot be read.
std::string read_text(const std::string& path);

}  // namespace surefoot::test
