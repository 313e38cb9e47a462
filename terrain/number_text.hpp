// How numbers are written in documents, whatever the locale.
#pragma once

#include <string>
#include <string_view>

namespace surefoot::terrain {

enum class NumberForm { not_a_number, leading_zero, integer, decimal };

/// The form of an unsigned number: digits [. digits] [e [sign] digits], with digits on at least one side of the point.
NumberForm form_of(std::string_view text);
std::string_view without_sign(std::string_view text);
bool is_digits(std::string_view text);  ///< and not empty
bool is_number(std::string_view text);

/// What to write instead of a text that is no number, for the ways in which numbers are commonly written elsewhere.
std::string number_meant_by(std::string_view text);

}  // namespace surefoot::terrain
