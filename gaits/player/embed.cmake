# cmake -DOUTPUT=FILE.cpp -P embed.cmake: writes player_page(), the template with style and scripts in it.
set(folder ${CMAKE_CURRENT_LIST_DIR})
file(READ ${folder}/page.html page)
file(READ ${folder}/style.css style)
set(script "")
foreach(part motion camera picture words timeline controls)
  file(READ ${folder}/${part}.js text)
  string(APPEND script "${text}\n")
endforeach()
# Neither may end its element early.
foreach(text IN ITEMS "${style}" "${script}")
  if("${text}" MATCHES "</|<!--")
    message(FATAL_ERROR "player: style and scripts must not contain '</' or '<!--'")
  endif()
endforeach()
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
if("${page}" MATCHES "\\)player\"")
  message(FATAL_ERROR "player: the page contains the end of the string it is put in")
endif()
file(WRITE ${OUTPUT} "// Made by gaits/player/embed.cmake.\n#include \"gaits/player_page.hpp\"\n\n"
  "namespace surefoot::gaits {\n\nstd::string_view player_page() { return R\"player(${page})player\"; }\n\n"
  "}  // namespace surefoot::gaits\n")
