// The usual causes of what the parser only calls invalid.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "terrain/source.hpp"

namespace surefoot::terrain {

/// Where the line above a position lacks a colon, or the space behind it or behind its dash: "; ..." as below, else "".
std::string advice_on_line_above(const Source& source, std::size_t position);

/// What may be wrong where the parser gave up with `message` at a position of the text, as "; ..." to be put behind it;
/// "" where the message speaks for itself. `open` is where the innermost list or map that is not ended yet begins.
std::string yaml_advice(const Source& source, std::string_view message, std::size_t position,
                        std::optional<std::size_t> open);

}  // namespace surefoot::terrain
