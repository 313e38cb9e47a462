// A file that is replaced as a whole or not at all: written beside its target under a temporary name, then renamed.
// Until commit() the target is as it was; a program that dies before leaves it so, and one that is asked to end
// (signals.hpp) takes the temporary file with it. Whether the place can be written
// to is found at once, before any long work. Devices and pipes (/dev/stdout) cannot be replaced and are written to
// directly.
#pragma once

#include <string>
#include <string_view>

namespace surefoot::planner {

class OutputFile {
 public:
  /// Throws OutputError if the target is a directory, may not be written, or a file cannot be made beside it.
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Writes the temporary file, to the disk; the target is untouched. What cannot be replaced is written now, before
  /// any file takes its place. Throws OutputError.
  void stage(std::string_view text);
  /// Puts what was staged in the place of the target.
  void commit();

  const std::string& path() const { return path_; }
  /// Both names lead to the same file, existing or not.
  bool same_as(const std::string& other) const;

 private:
  int make_temporary();
  void drop_temporary();
  std::string path_;       // as given
  std::string target_;     // symbolic links followed
  std::string temporary_;  // empty while there is none
  unsigned mode_ = 0;      // permission bits of the file to be
  bool replaceable_ = true;
};

}  // namespace surefoot::planner
