// Where a command puts its result, pictures and data: files of their own, or one of them on standard output. Nothing is
// written until all of it is there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/output_file.hpp"

namespace surefoot::planner {

class FigureOutputs {
 public:
  struct Request {
    const char* option;               ///< "--svg"
    std::optional<std::string> path;  ///< as given, "-" is stdout; nothing: not wanted
  };
  /// `input` is what the command reads, "-" or nothing for no file. Throws InputError where two of them are one,
  /// OutputError where a file cannot be written.
  FigureOutputs(const std::vector<Request>& requests, const std::optional<std::string>& input);

  bool wants(std::string_view option) const;
  /// The file it goes to; nullptr if it goes to standard output or is not wanted.
  const OutputFile* file(std::string_view option) const;
  /// Standard output holds one of them, and nothing else.
  bool to_stdout() const;
  /// Stages the text of a wanted output.
  void put(std::string_view option, const std::string& text);
  /// Standard output is written, then files take their places; each is told of on standard error unless `quiet`.
  void commit(bool quiet = false);

 private:
  struct Target {
    const char* option;
    std::unique_ptr<OutputFile> file;  ///< none: stdout
    std::string text;                  ///< for stdout
  };
  static Target open(const Request& request, const std::optional<std::string>& input);
  const Target* find(std::string_view option) const;

  std::vector<Target> targets_;
};

}  // namespace surefoot::planner
