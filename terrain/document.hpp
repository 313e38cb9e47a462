// A YAML (or JSON) file as a plain tree whose every node knows where it stands, so that loaders can
// say what is wrong with file, line and column. All the traps of the parser are dealt with here, once:
// trailing content, several documents, duplicate keys, aliases, tags, depth, size, unclosed quotes, directories,
// byte-order mark, control characters. What is read is UTF-8; numbers do not depend on the locale.
// A loader throws at the first fault. With a FaultList the same loader goes on after each and all of them are kept:
// whatever stands on its own is read under Node::attempt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot::terrain {

// Limits of what is read; beyond them InputError. A terrain of a million vertices has three million nodes.
constexpr std::size_t max_depth = 64;                          // containers within containers
constexpr std::size_t max_nodes = 16'000'000;                  // 48 bytes each
constexpr std::size_t max_file_size = std::size_t{512} << 20;  // [bytes]

/// Bad input: one line "file:line:column: message" (no prefix, no line feed).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message, std::size_t line_ = 0, std::size_t column_ = 0)
      : std::runtime_error(message), line(line_), column(column_) {}
  std::size_t line, column;  ///< from 1; 0 where no place in a text is to blame
};

/// The faults of one document that is read on after the first.
class FaultList {
 public:
  static constexpr std::size_t most_kept = 100;  ///< further ones are only counted
  void add(const InputError& fault);
  std::size_t count() const { return count_; }
  bool full() const { return count_ >= most_kept; }
  std::vector<InputError> kept() const;  ///< in the order of the text

 private:
  std::vector<InputError> kept_;
  std::size_t count_ = 0;
};

/// Thrown instead of InputError where only the consequence of a fault that a FaultList holds already could be said.
struct AlreadyTold {};

/// The keys of a map.
using Keys = std::initializer_list<std::string_view>;

/// Where each key of a format belongs: a place as "inside \"robot\"", and its keys.
using KeyHomes = std::vector<std::pair<std::string_view, std::vector<std::string_view>>>;

struct Source;  // the text that nodes point into

/// One value of the tree. `what` names the value in messages, as "friction" or "robot.reach".
class Node {
 public:
  enum class Kind { null, scalar, sequence, map };

  Node() = default;
  Node(Node&&) noexcept = default;
  Node& operator=(Node&&) noexcept = default;

  Kind kind() const { return static_cast<Kind>(content_.index()); }
  std::string where() const;                                 ///< "file:line:column", from 1, columns in characters
  [[noreturn]] void fail(const std::string& message) const;  ///< throws InputError at this node
  /// fail("what: 0.3 is given; expected ...") in the words for what this node is.
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const;

  /// Reads something that stands on its own. Without a FaultList no more than read(); with one, an InputError is kept
  /// there and the result is empty (false where read returns nothing).
  template <class Read>
  auto attempt(const Read& read) const;
  /// Attempts every one of several reads, then throws AlreadyTold if any failed.
  template <class... Reads>
  void attempt_each(const Reads&... reads) const;
  /// The document's list, or nullptr.
  FaultList* faults() const;

  // Scalars. Each throws InputError saying what was found and what is expected. A quoted scalar is a text, no number.
  double number(std::string_view what) const;             ///< finite; decimal or exponent form, no leading zeros
  double positive(std::string_view what) const;           ///< finite and > 0
  double not_negative(std::string_view what) const;       ///< finite and >= 0
  std::int64_t integer(std::string_view what) const;      ///< decimal digits only, no octal surprise
  std::int64_t integer_key(std::string_view what) const;  ///< the same of a key, which JSON puts in quotes
  bool boolean(std::string_view what) const;              ///< true | false
  std::string text(std::string_view what) const;          ///< any scalar, as written between its quotes if it has some
  bool is_null() const { return kind() == Kind::null; }   ///< nothing, ~ or null

  // Sequences.
  const std::vector<Node>& items(std::string_view what) const;
  /// Exactly n items.
  const std::vector<Node>& items(std::string_view what, std::size_t n) const;

  // Maps. Keys are scalars and unique (checked when the file is read). `what` names the map.
  const std::vector<std::pair<Node, Node>>& entries(std::string_view what) const;
  const Node* find(std::string_view key) const;  ///< nullptr if absent or not a map
  /// Absent: InputError that ends in `advice`; AlreadyTold if allow_only has
  /// suggested it for a misspelt key.
  const Node& require(std::string_view key, std::string_view what, std::string_view advice = "") const;
  /// Refuses every key that is not listed, and suggests where it belongs or the nearest one that is. False if there is
  /// one (and faults are kept).
  bool allow_only(Keys keys, std::string_view what) const;

 private:
  friend class DocumentBuilder;
  using Items = std::vector<Node>;
  using Entries = std::vector<std::pair<Node, Node>>;

  std::string described() const;  // for messages
  /// Of `map`; `before` is the entry before it, or nullptr.
  [[noreturn]] void refuse_key(const Node& map, const std::vector<std::string>& keys, std::string_view what,
                               const std::pair<Node, Node>* before) const;
  /// "did you mean "friction", which belongs inside "terrain"?" of a key that has another name, or "".
  std::string question_of_homes() const;
  std::string list_advice(std::size_t n) const;  // for messages
  std::string_view home() const;                 // where this key belongs, if that is known
  bool is_integer() const;
  /// `is_one`: whether a quoted text would be what is expected without its quotes.
  std::string_view plain_scalar(std::string_view what, std::string_view expected,
                                bool (*is_one)(std::string_view)) const;

  std::variant<std::monostate, std::string_view, Items, Entries> content_;  // in the order of Kind
  const Source* source_ = nullptr;
  std::uint32_t line_ = 0;         // from 0
  std::uint32_t column_ : 30 = 0;  // from 0, in bytes
  std::uint32_t quoted_ : 1 = 0;
  std::uint32_t told_ : 1 = 0;  // what is wrong with it is in the FaultList
};

template <class Read>
auto Node::attempt(const Read& read) const {
  using Result = std::invoke_result_t<Read>;
  if constexpr (std::is_void_v<Result>) {
    return attempt([&read] { return read(), true; }).has_value();
  } else {
    FaultList* list = faults();
    if (list == nullptr) return std::optional<Result>(read());
    try {
      return std::optional<Result>(read());
    } catch (const InputError& fault) {
      list->add(fault);
    } catch (const AlreadyTold&) {
    }
    return std::optional<Result>();
  }
}

template <class... Reads>
void Node::attempt_each(const Reads&... reads) const {
  bool whole = true;
  ((whole = attempt(reads) && whole), ...);
  if (!whole) throw AlreadyTold();
}

/// A parsed file. Not copyable: nodes point into it (and stay valid when it is moved).
class Document {
 public:
  /// Throws InputError: also for a file that is missing, a directory, unreadable, too large, empty or not text.
  static Document read_file(const std::string& path, FaultList* faults = nullptr);
  /// `name` stands for the file in messages. With `faults` (which must outlive it), anchors, aliases, tags and
  /// duplicate keys are kept there; what leaves no tree to read is thrown all the same (AlreadyTold if it is kept as
  /// well).
  static Document parse(std::string_view text, std::string name, FaultList* faults = nullptr);
  const Node& root() const { return root_; }
  /// Of keys that are refused it is said where they belong. `homes` must outlive the document.
  void know_homes(const KeyHomes& homes);
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

 private:
  Document();
  std::unique_ptr<Source> source_;
  Node root_;
};

/// The whole file. Throws InputError.
std::string read_text(const std::string& path);

/// All of an open file; `name` stands for it in messages. Throws InputError, also beyond max_file_size.
std::string read_all(std::FILE* file, const std::string& name);

/// A value for a message: on one line and of at most so many characters, whatever it holds.
std::string shown(std::string_view text, std::size_t most = 40);

/// ASCII letters in lower case.
std::string lower_case(std::string text);

/// The candidate nearest to a misspelt word, or "" if none is near (edit distance at most 2 or a third of the word, of
/// two to four letters 1, of one none, letter case aside; of equally near ones the first).
std::string near_miss(std::string_view word, const std::vector<std::string>& candidates);

/// The one of `keys` that is another name of a word, as "radius_of_gyration" of "rho"; "" if none is.
std::string other_name(std::string_view word, const std::vector<std::string>& keys);

/// Of `keys` the one that an unknown key stands for, or "": another name of it, misspelt, written without a space
/// behind its colon, or cut short.
std::string key_meant(std::string_view unknown, const std::vector<std::string>& keys);

/// The question for an unknown key of a map; of keys that it may stand for alike, those that the map has not go first.
/// "" if there is none.
std::string did_you_mean(std::string_view unknown, const std::vector<std::string>& keys,
                         const std::function<bool(const std::string&)>& is_given);

}  // namespace surefoot::terrain
