#include "planner/figure_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "planner/console.hpp"
#include "terrain/document.hpp"

namespace surefoot::planner {

using terrain::InputError;

FigureOutputs::FigureOutputs(const std::vector<Request>& requests, const std::optional<std::string>& input) {
  for (const Request& request : requests)
    if (request.path) targets_.push_back(open(request, input));
  for (auto one = targets_.begin(); one != targets_.end(); ++one)
    for (auto other = one + 1; other != targets_.end(); ++other) {
      if (!one->file && !other->file)
        throw InputError(
            fmt::format("{} - and {} -: standard output can hold one of them", one->option, other->option));
      if (one->file && other->file && one->file->same_as(other->file->path()))
        throw InputError(
            fmt::format("{}: both {} and {} would write this file", other->file->path(), one->option, other->option));
    }
}

namespace {

/// A name that promises another kind of file than the option writes.
void check_ending(std::string_view option, const std::string& path) {
  const std::string lower = terrain::lower_case(path);
  for (const std::string_view other : {".svg", ".html", ".png", ".pdf", ".jpg", ".jpeg", ".json", ".yaml"}) {
    const bool own = option == "-o" || other.substr(1) == option.substr(2);
    if (!own && lower.ends_with(other))
      throw InputError(fmt::format("{} {}: expected a name that ends in .{}", option, path, option.substr(2)));
  }
}

}  // namespace

FigureOutputs::Target FigureOutputs::open(const Request& request, const std::optional<std::string>& input) {
  Target target{request.option, nullptr, {}};
  if (*request.path == "-") return target;
  target.file = std::make_unique<OutputFile>(*request.path);
  if (input && *input != "-" && target.file->same_as(*input))
    throw InputError(fmt::format("{}: is the input itself and would be overwritten", *request.path));
  check_ending(request.option, *request.path);
  return target;
}

const FigureOutputs::Target* FigureOutputs::find(std::string_view option) const {
  const auto found =
      std::find_if(targets_.begin(), targets_.end(), [&](const Target& target) { return target.option == option; });
  return found == targets_.end() ? nullptr : &*found;
}

bool FigureOutputs::wants(std::string_view option) const { return find(option) != nullptr; }

const OutputFile* FigureOutputs::file(std::string_view option) const {
  const Target* target = find(option);
  return target ? target->file.get() : nullptr;
}

bool FigureOutputs::to_stdout() const {
  return std::any_of(targets_.begin(), targets_.end(), [](const Target& target) { return !target.file; });
}

void FigureOutputs::put(std::string_view option, const std::string& text) {
  for (Target& target : targets_)
    if (target.option == option) target.file ? target.file->stage(text) : void(target.text = text);
}

void FigureOutputs::commit(bool quiet) {
  for (const Target& target : targets_)
    if (!target.file) write_stdout(target.text);
  for (const Target& target : targets_)
    if (target.file) {
      target.file->commit();
      if (!quiet) note("wrote " + target.file->path());
    }
}

}  // namespace surefoot::planner
