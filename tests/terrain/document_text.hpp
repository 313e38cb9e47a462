// Texts read as documents, and what is said of those that are refused.
#pragma once

#include <string>
#include <string_view>

#include "terrain/document.hpp"

namespace surefoot::terrain {

inline Document parse(std::string_view text) { return Document::parse(text, "f.yaml"); }

template <class Action>
std::string error_of(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline std::string parse_error(std::string_view text) {
  return error_of([&] { parse(text); });
}

struct Refusal {
  std::string text, message;
};

}  // namespace surefoot::terrain
