// The command `bench` is a program of its own, surefoot-bench, since it needs libraries that nothing else does: this
// one hands over to it.
#pragma once

namespace surefoot::planner {

/// Runs surefoot-bench beside this program in its place, with the words after `bench`. Returns only if that fails: one
/// line of what to do, and the exit status for bad input.
int run_bench(char** words);

}  // namespace surefoot::planner
