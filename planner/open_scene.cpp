#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "planner/canned_scenes.hpp"
#include "planner/commands.hpp"

namespace surefoot::planner {

std::string read_stdin() {
  constexpr std::size_t most = 256u << 20;  // bytes: far above any scene or plan, below any machine's memory
  std::string text;
  char chunk[1 << 16];
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, chunk, sizeof chunk);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw terrain::InputError(fmt::format("<stdin>: cannot read: {}", std::strerror(errno)));
    if (count == 0) return text;
    text.append(chunk, static_cast<std::size_t>(count));
    if (text.size() > most) throw terrain::InputError(fmt::format("<stdin>: more than {} bytes", most));
  }
}

gaits::Scene open_scene(const std::string& path) {
  if (path == "-") return gaits::parse_scene(read_stdin(), "<stdin>");
  return gaits::load_scene(scene_file(path));
}

}  // namespace surefoot::planner
