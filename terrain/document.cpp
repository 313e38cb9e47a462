#include "terrain/document.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "terrain/flow_brackets.hpp"
#include "terrain/source.hpp"
#include "terrain/yaml_advice.hpp"

namespace surefoot::terrain {

/// Turns the parser's events into nodes. The parser is asked for events rather than for its own tree because only
/// events show aliases, duplicate keys, quotes and every mark.
class DocumentBuilder : public YAML::EventHandler {
 public:
  explicit DocumentBuilder(Source& source) : source_(source) {}

  bool complete() const { return documents_ > 0; }
  Node take_root() { return std::move(pool_.front()); }
  std::size_t last_quoted() const { return last_quoted_; }
  YAML::Mark last_mark() const { return last_mark_; }
  /// Where the innermost list or map that is not ended begins.
  std::optional<std::size_t> open() const {
    if (frames_.empty()) return std::nullopt;
    return static_cast<std::size_t>(frames_.back().mark.pos);
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    const std::string advice = advice_on_line_above(source_, static_cast<std::size_t>(mark.pos));
    fail(mark, "content after the end of the value; expected one value" +
                   (advice.empty() ? " (is the indentation right?)" : advice));
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    Node node = make(mark);
    if (expects_key()) {
      const auto at = static_cast<std::size_t>(mark.pos);
      const bool comma = at < source_.text.size() && source_.text[at] == ',';
      fail(mark, comma                                ? "nothing before the comma; expected a key"
                 : source_.has_colon_on_next_line(at) ? "this key ends its line; expected its colon on the same line"
                                                      : "nothing before the colon; expected a key");
    }
    // A value left out is marked where the parser noticed, often a line later; its key says it better.
    if (in_map() && !written_null(mark)) {
      node.line_ = pool_.back().line_;
      node.column_ = pool_.back().column_;
    }
    pool_.push_back(std::move(node));
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    tell(mark, "aliases (*name) are not accepted");
    if (expects_key()) throw AlreadyTold();
    Node node = make(mark);
    node.told_ = 1;
    pool_.push_back(std::move(node));
  }
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    tell(mark, "anchors (&" + shown(name) + ") are not accepted");
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    Node node = make(mark);
    node.told_ = !check_tag(mark, tag);
    node.quoted_ = tag == "!";
    if (node.quoted_) last_quoted_ = static_cast<std::size_t>(mark.pos);
    node.content_ = store(static_cast<std::size_t>(mark.pos) + node.quoted_, value);
    pool_.push_back(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, false);
  }
  void OnSequenceEnd() override {
    const Frame frame = close();
    Node::Items items;
    items.reserve(pool_.size() - frame.first);
    std::move(pool_.begin() + frame.first, pool_.end(), std::back_inserter(items));
    replace(frame, std::move(items));
  }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, tag, true);
  }
  void OnMapEnd() override {
    const Frame frame = close();
    Node::Entries entries;
    entries.reserve((pool_.size() - frame.first) / 2);
    for (std::size_t i = frame.first; i + 1 < pool_.size(); i += 2) {
      entries.emplace_back(std::move(pool_[i]), std::move(pool_[i + 1]));
    }
    check_unique(entries);
    replace(frame, std::move(entries));
  }

 private:
  struct Frame {
    YAML::Mark mark;
    bool told;             // as of its node
    std::ptrdiff_t first;  // its children are pool_[first ...], keys and values in turn
    bool map;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw source_.error(static_cast<std::size_t>(mark.line), static_cast<std::size_t>(mark.column), message);
  }

  /// A fault that does not stop the building of the tree where faults are kept.
  void tell(const YAML::Mark& mark, const std::string& message) const {
    if (!source_.faults) fail(mark, message);
    if (source_.faults->full()) return source_.faults->add(InputError(""));
    source_.faults->add(
        source_.error(static_cast<std::size_t>(mark.line), static_cast<std::size_t>(mark.column), message));
  }

  Node make(const YAML::Mark& mark) {
    last_mark_ = mark;
    if (++nodes_ > max_nodes) fail(mark, "more than " + std::to_string(max_nodes) + " values in one file");
    Node node;
    node.source_ = &source_;
    node.line_ = static_cast<std::uint32_t>(mark.line);
    node.column_ = static_cast<std::uint32_t>(mark.column) & 0x3FFFFFFFu;
    return node;
  }

  bool in_map() const { return !frames_.empty() && frames_.back().map; }
  bool expects_key() const {
    return in_map() && (static_cast<std::ptrdiff_t>(pool_.size()) - frames_.back().first) % 2 == 0;
  }

  bool written_null(const YAML::Mark& mark) const {
    const std::string_view rest =
        std::string_view(source_.text).substr(std::min(source_.text.size(), static_cast<std::size_t>(mark.pos)));
    return rest.starts_with('~') || rest.starts_with("null") || rest.starts_with("Null") || rest.starts_with("NULL");
  }

  /// Whether there is none.
  bool check_tag(const YAML::Mark& mark, const std::string& tag) const {
    const auto at = static_cast<std::size_t>(mark.pos);
    const bool written = at < source_.text.size() && source_.text[at] == '!';
    if (!written && (tag.empty() || tag == "?" || tag == "!")) return true;
    tell(mark, "tags (" + shown(tag) + ") are not accepted");
    return false;
  }

  /// A view of the value: into the text where it stands there as it is, else of a copy.
  std::string_view store(std::size_t position, const std::string& value) {
    const std::string_view text = source_.text;
    if (position <= text.size() && text.substr(position, value.size()) == value) {
      return text.substr(position, value.size());
    }
    return source_.extra.emplace_back(well_formed(value));
  }

  void open(const YAML::Mark& mark, const std::string& tag, bool map) {
    const bool told = !check_tag(mark, tag);
    if (expects_key()) {
      check_flow_brackets(source_);  // what is not closed is taken for a key
      fail(mark, "a list or map as a key; expected a word");
    }
    if (frames_.size() >= max_depth) fail(mark, "nested deeper than " + std::to_string(max_depth) + " levels");
    frames_.push_back({mark, told, static_cast<std::ptrdiff_t>(pool_.size()), map});
  }

  Frame close() {
    const Frame frame = frames_.back();
    frames_.pop_back();
    return frame;
  }

  template <class Content>
  void replace(const Frame& frame, Content content) {
    pool_.resize(static_cast<std::size_t>(frame.first));
    Node node = make(frame.mark);
    node.content_ = std::move(content);
    node.told_ = frame.told;
    pool_.push_back(std::move(node));
  }

  /// Refuses keys that were there before, in the order of the file; where faults are kept the first of each stays.
  static void check_unique(Node::Entries& entries) {
    std::vector<std::size_t> order(entries.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::size_t i) { return std::get<std::string_view>(entries[i].first.content_); };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) { return key(l) < key(r); });
    std::vector<std::pair<std::size_t, std::size_t>> again;  // the later one and the first with that key
    for (std::size_t k = 1, first = 0; k < order.size(); ++k) {
      if (key(order[first]) == key(order[k])) {
        again.emplace_back(order[k], order[first]);
      } else {
        first = k;
      }
    }
    std::sort(again.begin(), again.end());
    for (const auto& [later, first] : again) {
      const Node& node = entries[later].first;
      node.attempt([&, at = later, line = entries[first].first.line_ + 1] {
        node.fail("key \"" + shown(key(at)) + "\" is given twice; first at line " + std::to_string(line));
      });
    }
    if (again.empty()) return;
    Node::Entries kept;
    for (std::size_t i = 0, next = 0; i < entries.size(); ++i) {
      if (next < again.size() && again[next].first == i) {
        ++next;
      } else {
        kept.push_back(std::move(entries[i]));
      }
    }
    entries = std::move(kept);
  }

  Source& source_;
  std::vector<Node> pool_;
  std::vector<Frame> frames_;
  std::size_t nodes_ = 0;
  int documents_ = 0;
  std::size_t last_quoted_ = std::string::npos;
  YAML::Mark last_mark_;
};

namespace {

constexpr std::size_t longest_message = 200;  // characters of the parser's messages, which may quote what it read

/// A message of the parser without the raw byte that it may end with (of an escape, or its mark for the end of the
/// file).
std::string readable(std::string message) {
  const auto raw = std::find_if(message.begin(), message.end(), [](char c) { return c < 0x20 || c > 0x7E; });
  if (raw == message.end()) return message;
  message.erase(raw, message.end());
  message.erase(message.find_last_not_of(": ") + 1);
  return message;
}

}  // namespace

Document::Document() : source_(std::make_unique<Source>()) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

void Document::know_homes(const KeyHomes& homes) { source_->homes = &homes; }

Document Document::read_file(const std::string& path, FaultList* faults) {
  return parse(read_text(path), path, faults);
}

Document Document::parse(std::string_view text, std::string name, FaultList* faults) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Document document;
  Source& source = *document.source_;
  source.name = std::move(name);
  source.take(text);
  source.faults = faults;
  source.check_characters();
  if (source.text.starts_with("<"))
    throw source.error(0, 0, "this is a picture or a page (SVG, HTML), not YAML or JSON");

  std::istringstream stream(source.text);
  DocumentBuilder builder(source);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {  // a second document is refused by the builder
    }
  } catch (const YAML::Exception& error) {
    if (builder.last_quoted() != std::string::npos) source.check_quotes(builder.last_quoted());
    check_flow_brackets(source);
    const YAML::Mark mark = error.mark.is_null() ? builder.last_mark() : error.mark;
    const std::string message = readable(error.msg);
    const std::string advice = yaml_advice(source, message, static_cast<std::size_t>(mark.pos), builder.open());
    throw source.error(static_cast<std::size_t>(mark.line), static_cast<std::size_t>(mark.column),
                       not_valid(source) + shown(message, longest_message) + advice);
  }
  if (!builder.complete()) throw source.error(0, 0, "nothing but white space or comments");
  if (builder.last_quoted() != std::string::npos) source.check_quotes(builder.last_quoted());
  document.root_ = builder.take_root();
  return document;
}

}  // namespace surefoot::terrain
