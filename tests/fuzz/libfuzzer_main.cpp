// Entry of libFuzzer for one target (SUREFOOT_FUZZ_TARGET names it). A broken promise ends it, as a crash does.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  surefoot::fuzz::SUREFOOT_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
