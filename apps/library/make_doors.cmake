# SPDX-License-Identifier: MIT
# Makes the public headers: cmake -D SOURCE=<sources> -D OUTPUT=<folder> -D FLAGS=<how Eigen is to be compiled> -P make_doors.cmake
# Each is its headers of the tree one after the other: includes of the outside once and sorted, those of the project
# dropped or replaced by the door that shows them. What no door shows cannot stand behind one: that is an error.
cmake_minimum_required(VERSION 3.25)

function(door name about)
  set(own "")
  set(doors "")
  set(outside "")
  set(body "")
  foreach(header IN LISTS ARGN)
    file(READ ${SOURCE}/${header} text)
    string(REGEX MATCHALL "#include [<\"][^>\"]+[>\"]" includes "${text}")
    foreach(include IN LISTS includes)
      if(include MATCHES "<")
        list(APPEND outside "${include}")
        continue()
      endif()
      string(REGEX REPLACE "#include \"(.*)\"" "\\1" path "${include}")
      get_property(home GLOBAL PROPERTY "door of ${path}")
      if(NOT home)
        message(FATAL_ERROR "${header} stands behind <sunder/${name}.hpp> and includes ${path}, which no door shows yet: "
                            "list it first (apps/library/doors.cmake), or let ${header} do without it")
      elseif(NOT home STREQUAL name)
        list(APPEND doors "#include <sunder/${home}.hpp>")
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY "door of ${header}" ${name})
    string(REGEX REPLACE "(// SPDX[^\n]*|#pragma once|#include [^\n]*)\n" "" text "${text}")
    string(APPEND body "\n${text}")
  endforeach()
  # One namespace in place of one after the other; what a header says of itself stays as a comment in it.
  string(REGEX REPLACE "\n}  // namespace sunder\n+((// [^\n]*\n)*)\n*namespace sunder {\n" "\n\\1" body "${body}")
  string(REGEX REPLACE "\n\n\n+" "\n\n" body "${body}")
  foreach(list doors outside)
    list(REMOVE_DUPLICATES ${list})
    list(SORT ${list})
    list(JOIN ${list} "\n" ${list})
  endforeach()
  if(outside MATCHES "Eigen")
    string(PREPEND body "\n#ifndef EIGEN_DONT_VECTORIZE\n"
           "#error \"compile with ${FLAGS}, as sunder was (docs/howto/embed.md)\"\n#endif\n"
           "static_assert(EIGEN_MAX_ALIGN_BYTES == 16,\n"
           "              \"compile with ${FLAGS}, as sunder was (docs/howto/embed.md)\");\n")
  endif()
  set(file ${OUTPUT}/sunder/${name}.hpp)
  file(WRITE ${file}.tmp "// SPDX-License-Identifier: MIT\n// ${about}\n#pragma once\n\n${outside}\n\n${doors}\n${body}")
  file(READ ${file}.tmp text)
  string(REGEX REPLACE "\n\n\n+" "\n\n" text "${text}")
  file(WRITE ${file}.tmp "${text}")
  file(COPY_FILE ${file}.tmp ${file} ONLY_IF_DIFFERENT)
  file(REMOVE ${file}.tmp)
endfunction()

include(${CMAKE_CURRENT_LIST_DIR}/doors.cmake)
