// What is wrong with a command line, in one line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace surefoot::planner {

/// Name of the type of options that take one.
constexpr const char* whole_number = "N";

/// Said where there is none, with those that there are.
std::string command_missing(const CLI::App& app);

/// What the parser found, with the option or command that may have been meant.
std::string usage_fault(const CLI::App& app, const CLI::ParseError& fault, int count, char** words);

/// A word such as -o=FILE, whose file would be named =FILE; "" if there is none.
std::string equals_sign(const CLI::App& app, int count, char** words);

/// An argument of the command that is empty, as an unset variable of a script leaves it; "" if there is none.
std::string empty_argument(const CLI::App& app);

/// A number that the parser has cut to the range of its type, upwards or to 0; "" if there is none.
std::string overflowing_argument(const CLI::App& app);

}  // namespace surefoot::planner
