// The page that plays a plan, as text with two marks: @TITLE@ for its name, @DATA@ for player_data(). Its source is
// player/: one template, its style and its scripts, put together when building.
#pragma once

#include <string_view>

namespace surefoot::gaits {

std::string_view player_page();

}  // namespace surefoot::gaits
