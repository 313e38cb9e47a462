// The page of a plan: player/ (made one text when building, player/embed.cmake) with the plan's data put in its places.
#include <stdexcept>

#include "gaits/plan_io.hpp"
#include "gaits/plan_words.hpp"
#include "gaits/player_data.hpp"
#include "gaits/player_page.hpp"
#include "gaits/svg_canvas.hpp"

namespace surefoot::gaits {

std::string to_html(const Scene& scene, const Plan& plan, const std::vector<std::string>& faults) {
  constexpr std::string_view title_mark = "@TITLE@", data_mark = "@DATA@";
  const std::string_view page = player_page();
  const std::size_t title = page.find(title_mark), data = page.find(data_mark);
  if (title == page.npos || data == page.npos || data < title) throw std::logic_error("player page without its marks");
  std::string text(page.substr(0, title));
  text += xml_escape(title_of(plan, !faults.empty()));
  text += page.substr(title + title_mark.size(), data - title - title_mark.size());
  text += player_data(scene, plan, faults);
  return text.append(page.substr(data + data_mark.size()));
}

}  // namespace surefoot::gaits
