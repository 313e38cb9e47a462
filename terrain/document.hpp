// A YAML (or JSON) file as a plain tree whose every node knows where it stands, so that loaders can
// say what is wrong with file, line and column. All the traps of the parser are dealt with here, once:
// trailing content, several documents, duplicate keys, aliases, depth, size, directories, byte-order mark.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot::terrain {

/// Bad input: one line "file:line:column: message" (no prefix, no line feed).
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Node {
 public:
  enum class Kind { null, scalar, sequence, map };

  Kind kind() const { return kind_; }
  const std::string& where() const;                      ///< "file:line:column" (built when asked for)
  [[noreturn]] void fail(const std::string& message) const;  ///< throws InputError at this node

  // Scalars. Each throws InputError saying what was found and what is expected.
  double number(std::string_view what) const;            ///< finite
  double positive(std::string_view what) const;          ///< finite and > 0
  double not_negative(std::string_view what) const;      ///< finite and >= 0
  std::int64_t integer(std::string_view what) const;     ///< decimal digits only, no octal surprise
  bool boolean(std::string_view what) const;             ///< true | false
  std::string text(std::string_view what) const;
  bool is_null() const { return kind_ == Kind::null; }

  // Sequences.
  const std::vector<Node>& items(std::string_view what) const;
  /// Exactly n items.
  const std::vector<Node>& items(std::string_view what, std::size_t n) const;

  // Maps. Keys are unique (checked when the file is read).
  const std::vector<std::pair<Node, Node>>& entries(std::string_view what) const;
  const Node* find(std::string_view key) const;                     ///< nullptr if absent or not a map
  const Node& require(std::string_view key, std::string_view what) const;
  /// Refuses every key that is not listed, and suggests the nearest one that is.
  void allow_only(std::initializer_list<std::string_view> keys, std::string_view what) const;

 private:
  friend class DocumentBuilder;
  Kind kind_ = Kind::null;
  bool quoted_ = false;
  std::string scalar_;
  std::vector<Node> items_;
  std::vector<std::pair<Node, Node>> entries_;
  const std::string* file_ = nullptr;
  int line_ = 0, column_ = 0;
};

/// A parsed file. Not copyable: nodes point into it.
class Document {
 public:
  static Document read_file(const std::string& path);
  static Document parse(std::string_view text, std::string name);
  const Node& root() const { return *root_; }
  Document(Document&&) noexcept = default;
  Document& operator=(Document&&) noexcept = default;

 private:
  Document() = default;
  std::shared_ptr<const std::string> name_;
  std::shared_ptr<const Node> root_;
};

/// The candidate nearest to a misspelt word, or "" if none is near (edit distance at most 2 or a third of the word).
std::string near_miss(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace surefoot::terrain
