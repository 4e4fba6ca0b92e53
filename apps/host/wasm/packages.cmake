# SPDX-License-Identifier: MIT
# Header-only packages of this machine for another one: a folder of links to just these, because
# all of /usr/include would bring the machine's own C library.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(package Eigen fmt nlohmann Spectra)
  find_path(SUNDER_${package}_PLACE ${package} PATHS /usr/include /usr/include/eigen3 /usr/local/include
            REQUIRED NO_DEFAULT_PATH)
  file(CREATE_LINK ${SUNDER_${package}_PLACE}/${package} ${headers}/${package} SYMBOLIC)
endforeach()
set(SPECTRA_INCLUDE_DIR ${headers} CACHE PATH "libspectra-dev")

add_library(sunder_headers INTERFACE)
target_include_directories(sunder_headers SYSTEM INTERFACE $<BUILD_INTERFACE:${headers}>)
add_library(Eigen3::Eigen ALIAS sunder_headers)
add_library(nlohmann_json::nlohmann_json ALIAS sunder_headers)
add_library(sunder_fmt INTERFACE)
target_link_libraries(sunder_fmt INTERFACE sunder_headers)
# Without streams and locales the engine is 0.2 MB smaller.
target_compile_definitions(sunder_headers INTERFACE JSON_NO_IO)
target_compile_definitions(sunder_fmt INTERFACE FMT_HEADER_ONLY "FMT_STATIC_THOUSANDS_SEPARATOR=','")
add_library(fmt::fmt ALIAS sunder_fmt)
