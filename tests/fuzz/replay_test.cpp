// The corpus, and mutations of it that are the same in every run, through every fuzzed target: a bounded stand-in for
// libFuzzer that any compiler can build.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/targets.hpp"
#include "tests/support/rounds.hpp"

namespace surefoot::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_input = 8192;  // bytes: what grows beyond is cut

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::pair<std::string, std::string>> corpus(const std::string& target) {
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const auto& entry : fs::directory_iterator(fs::path(SUREFOOT_TESTS_DIR) / "fuzz/corpus" / target))
    inputs.emplace_back(entry.path().filename().string(), read(entry.path()));
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

/// The words of tokens.dict: lines "..." with escapes \xNN.
std::vector<std::string> tokens() {
  std::vector<std::string> words;
  std::ifstream file(fs::path(SUREFOOT_TESTS_DIR) / "fuzz/tokens.dict");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('"')) continue;
    std::string word;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      }
    }
    words.push_back(word);
  }
  return words;
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed), tokens_(tokens()) {}

  std::string mutate(std::string text, const std::string& other) {
    for (std::size_t n = 1 + below(4); n > 0; --n) change(text, other);
    if (text.size() > longest_input) text.resize(longest_input);
    return text;
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

 private:
  void change(std::string& text, const std::string& other) {
    const std::size_t at = below(text.size() + 1), length = below(std::min<std::size_t>(text.size() - at, 64) + 1);
    switch (below(8)) {
      case 0: text.insert(at, tokens_[below(tokens_.size())]); return;
      case 1: text.replace(at, length, tokens_[below(tokens_.size())]); return;
      case 2: text.erase(at, length); return;
      case 3: text.insert(below(text.size() + 1), text.substr(at, length)); return;
      case 4: text.insert(at, other.substr(below(other.size() + 1), 1 + below(64))); return;
      case 5: text.insert(at, 1, static_cast<char>(below(256))); return;
      case 6: change_digit(text, at); return;
      default:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
    }
  }

  void change_digit(std::string& text, std::size_t from) {
    const auto at = text.find_first_of("0123456789", from);
    if (at != std::string::npos) text[at] = "0123456789-.e"[below(13)];
  }

  std::mt19937_64 random_;
  std::vector<std::string> tokens_;
};

std::string visible(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    constexpr const char* digits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F && c != '\\') shown += c;
    else shown += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
  }
  return shown;
}

void run(const Target& target, const std::string& input) {
  INFO(target.name << ": " << visible(input));
  CHECK_NOTHROW(target.run(input));
}

/// SUREFOOT_FUZZ_ROUNDS asks for more.
int rounds_wanted() {
  const char* asked = std::getenv("SUREFOOT_FUZZ_ROUNDS");
  return asked ? std::atoi(asked) : test::rounds(4000);
}

TEST_CASE("Every input of the corpus keeps the promises of its target", "[fuzz]") {
  for (const Target& target : targets()) {
    const auto inputs = corpus(target.name);
    REQUIRE_FALSE(inputs.empty());
    for (const auto& [name, input] : inputs) {
      INFO(name);
      run(target, input);
    }
  }
}

TEST_CASE("Mutations of the corpus keep the promises of their target", "[fuzz]") {
  for (const Target& target : targets()) {
    const auto inputs = corpus(target.name);
    Mutator mutator(1);
    for (int round = rounds_wanted(); round > 0; --round) {
      const std::string& input = inputs[mutator.below(inputs.size())].second;
      run(target, mutator.mutate(input, inputs[mutator.below(inputs.size())].second));
    }
  }
}

}  // namespace
}  // namespace surefoot::fuzz
