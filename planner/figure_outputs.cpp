#include "planner/figure_outputs.hpp"

#include <fmt/format.h>

#include "planner/console.hpp"
#include "terrain/document.hpp"

namespace surefoot::planner {

using terrain::InputError;

FigureOutputs::FigureOutputs(const std::optional<std::string>& svg, const std::optional<std::string>& json,
                             const std::optional<std::string>& input)
    : svg_(open(svg, input)), json_(open(json, input)) {
  if (svg_.wanted_on_stdout() && json_.wanted_on_stdout())
    throw InputError("--svg - and --json -: standard output can hold one of them");
  if (svg_.file && json_.file && svg_.file->same_as(json_.file->path()))
    throw InputError(fmt::format("{}: both --svg and --json would write this file", json_.file->path()));
}

FigureOutputs::Target FigureOutputs::open(const std::optional<std::string>& path,
                                          const std::optional<std::string>& input) {
  Target target{path.has_value(), nullptr};
  if (!path || *path == "-") return target;
  target.file = std::make_unique<OutputFile>(*path);
  if (input && *input != "-" && target.file->same_as(*input))
    throw InputError(fmt::format("{}: is the input itself and would be overwritten", *path));
  return target;
}

void FigureOutputs::put(const Target& target, const std::string& text) {
  target.file ? target.file->stage(text) : write_stdout(text);
}

void FigureOutputs::commit() const {
  for (const Target* target : {&svg_, &json_})
    if (target->file) {
      target->file->commit();
      note("wrote " + target->file->path());
    }
}

}  // namespace surefoot::planner
