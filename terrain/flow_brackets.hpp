// Brackets of a text that is one list or map on its own (JSON, or YAML written so).
#pragma once

#include "terrain/source.hpp"

namespace surefoot::terrain {

/// Whether it is such a text.
bool is_flow_text(const Source& source);
/// How a message begins that tells why a text is not what it looks like.
const char* not_valid(const Source& source);

/// Throws InputError at the first bracket that closes another one than was opened last, or at the end if one is still
/// open. For texts that the parser has refused.
void check_flow_brackets(const Source& source);

}  // namespace surefoot::terrain
