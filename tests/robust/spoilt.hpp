// Texts that are no scene, no plan and no posture, however they are read.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/planner/scene_text.hpp"

namespace surefoot::tests {

struct Spoilt {
  std::string what, text;
};

inline std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  text.reserve(piece.size() * count);
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

inline std::string rubbish(std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::string text(size, '\0');
  for (char& c : text) c = static_cast<char>(random() & 0xFF);
  return text;
}

inline std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  return wide;
}

/// Nine levels of ten aliases each: 10^9 values once written out.
inline std::string bomb() {
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    const std::string before = fmt::format("*a{}", i - 1), name = fmt::format("a{}", i);
    text += name + ": &" + name + " [" + repeated(before + ", ", 9) + before + "]\n";
  }
  return text;
}

inline std::vector<Spoilt> spoilt_texts() {
  const std::string sequences = repeated("[", 100'000), maps = repeated("{a: ", 100'000);
  return {
      {"nothing", ""},
      {"white space", " \n\n  \n"},
      {"a comment", "# surefoot: 1\n"},
      {"a byte-order mark", "\xEF\xBB\xBF"},
      {"a number", "1\n"},
      {"aliases that grow", bomb()},
      {"a cycle", "&a [*a]\n"},
      {"a cycle of maps", "surefoot: &a {b: *a}\n"},
      {"merged keys", "surefoot: 1\n<<: *missing\n"},
      {"100,000 lists in each other", sequences},
      {"100,000 lists, closed again", sequences + repeated("]", 100'000)},
      {"100,000 maps in each other", maps},
      {"100,000 list items in each other", repeated("- ", 100'000)},
      {"100,000 keys in each other", repeated("? ", 100'000)},
      {"100,000 quotes", repeated("'", 99'999)},
      {"an endless text", std::string("surefoot: \"").append(repeated("x", 1 << 20))},
      {"a line of a megabyte", repeated("x", 1 << 20)},
      {"a key of a megabyte", repeated("x", 1 << 20) + ": 1\n"},
      {"a megabyte of line feeds", repeated("\n", 1 << 20) + "x\n"},
      {"a megabyte of commas", std::string("[").append(repeated(",", 1 << 20))},
      {"binary rubbish", rubbish(4096, 1)},
      {"more rubbish", rubbish(100'000, 2)},
      {"an ELF header", std::string("\x7f"
                                    "ELF\x02\x01\x01\0\0\0",
                                    10)},
      {"NUL", std::string("surefoot: 1\0\n", 13)},
      {"UTF-16", utf16(flat_scene)},
      {"Latin-1", "surefoot: 1\nname: M\xFCller\n"},
      {"a surrogate", "name: \xED\xA0\x80\n"},
      {"a cut sequence", "name: \xE2\x82"},
      {"carriage returns only", "surefoot: 1\rname: x\r"},
      {"tabs", "surefoot:\t1\n\tname: x\n"},
      {"an object of a language", "!!python/object/apply:os.system ['true']\n"},
      {"two documents", "surefoot: 1\n---\nsurefoot: 1\n"},
      {"the same key twice", "surefoot: 1\nsurefoot: 1\n"},
      {"NaN in JSON", R"({"surefoot": NaN})"},
      {"a number beyond doubles", R"({"surefoot": 1e999})"},
      {"half of JSON", R"({"surefoot": 1, "stances": [{"feet)"},
      {"XML", "<?xml version=\"1.0\"?><plan/>\n"},
  };
}

}  // namespace surefoot::tests
