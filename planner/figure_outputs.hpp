// Where a command that draws puts its picture and its data: files of their own, or one of them on standard output.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "planner/output_file.hpp"

namespace surefoot::planner {

class FigureOutputs {
 public:
  /// `svg` and `json` as given to the command, "-" is stdout; `input` is what the command reads, "-" or nothing for no
  /// file. Throws InputError where two of them are one, OutputError where a file cannot be written.
  FigureOutputs(const std::optional<std::string>& svg, const std::optional<std::string>& json,
                const std::optional<std::string>& input);

  bool wants_svg() const { return svg_.wanted; }
  bool wants_json() const { return json_.wanted; }
  /// Standard output holds the picture or the data, and nothing else.
  bool to_stdout() const { return svg_.wanted_on_stdout() || json_.wanted_on_stdout(); }
  void put_svg(const std::string& text) const { put(svg_, text); }
  void put_json(const std::string& text) const { put(json_, text); }
  /// Files take their places; each is told of on standard error.
  void commit() const;

 private:
  struct Target {
    bool wanted = false;
    std::unique_ptr<OutputFile> file;  ///< none: stdout
    bool wanted_on_stdout() const { return wanted && !file; }
  };
  static Target open(const std::optional<std::string>& path, const std::optional<std::string>& input);
  static void put(const Target& target, const std::string& text);

  Target svg_, json_;
};

}  // namespace surefoot::planner
