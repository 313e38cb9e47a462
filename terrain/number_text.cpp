#include "terrain/number_text.hpp"

#include <algorithm>
#include <cctype>

#include "terrain/document.hpp"

namespace surefoot::terrain {
namespace {

constexpr std::size_t longest_number = 64;  // longer ones are not looked at for a unit behind them

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t digits_at(std::string_view text, std::size_t i) {
  std::size_t end = i;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - i;
}

}  // namespace

NumberForm form_of(std::string_view text) {
  const std::size_t whole = digits_at(text, 0);
  std::size_t i = whole, part = 0;
  if (i < text.size() && text[i] == '.') {
    part = digits_at(text, i + 1);
    i += 1 + part;
  }
  if (whole + part == 0) return NumberForm::not_a_number;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
    const std::size_t exponent = digits_at(text, i);
    if (exponent == 0) return NumberForm::not_a_number;
    i += exponent;
  }
  if (i != text.size()) return NumberForm::not_a_number;
  if (whole > 1 && text[0] == '0') return NumberForm::leading_zero;
  return i == whole ? NumberForm::integer : NumberForm::decimal;
}

std::string_view without_sign(std::string_view text) {
  return text.starts_with('+') || text.starts_with('-') ? text.substr(1) : text;
}

bool is_digits(std::string_view text) { return !text.empty() && digits_at(text, 0) == text.size(); }

bool is_number(std::string_view text) { return form_of(without_sign(text)) != NumberForm::not_a_number; }

std::string number_meant_by(std::string_view text) {
  for (const std::string_view minus : {"\u2212", "\u2013", "\u2014"}) {  // minus sign, dashes
    if (text.starts_with(minus)) return "a plain minus sign, as in -0.25";
  }
  const std::size_t comma = text.find(',');
  if (comma != std::string_view::npos && is_digits(text.substr(comma + 1)) &&
      is_digits(without_sign(text.substr(0, comma)))) {
    return "a point, no comma: " +
           shown(std::string(text.substr(0, comma)) + "." + std::string(text.substr(comma + 1)));
  }
  std::size_t number = std::min(text.size(), longest_number);  // the longest beginning that is one
  while (number > 0 && !is_number(text.substr(0, number))) --number;
  const std::string_view rest = text.substr(std::min(text.find_first_not_of(' ', number), text.size()));
  const bool unit = !rest.empty() && (std::isalpha(static_cast<unsigned char>(rest[0])) || rest[0] == '%' ||
                                      rest.starts_with("\u00b0"));  // degrees
  if (number == 0 || !unit || rest == "e" || rest == "E" || std::any_of(rest.begin(), rest.end(), is_digit)) {
    return "a number such as 0.25 or 1e-3";
  }
  if (rest == "%") return "the number alone (a share of 10 % is 0.1)";
  return "the number alone, without a unit (metres, kilograms, seconds)";
}

}  // namespace surefoot::terrain
