# SPDX-License-Identifier: MIT
# Run by cpack before it packs. Debian wants the shared library in a package of its own, files of pkg-config by architecture,
# a manual of each program, and manuals and changes packed by gzip.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(stage ${CPACK_TEMPORARY_DIRECTORY})

file(GLOB_RECURSE shared "${stage}/library/usr/lib*/libsunder.so.*")
foreach(file ${shared})
  string(REPLACE "${stage}/library/" "${stage}/runtime/" target "${file}")
  cmake_path(GET target PARENT_PATH folder)
  file(MAKE_DIRECTORY ${folder})
  file(RENAME ${file} ${target})
endforeach()

set(folder ${stage}/library/usr/lib)
if(CPACK_SUNDER_ARCHITECTURE AND EXISTS ${folder}/pkgconfig)
  file(MAKE_DIRECTORY ${folder}/${CPACK_SUNDER_ARCHITECTURE})
  file(RENAME ${folder}/pkgconfig ${folder}/${CPACK_SUNDER_ARCHITECTURE}/pkgconfig)
  file(GLOB descriptions "${folder}/${CPACK_SUNDER_ARCHITECTURE}/pkgconfig/*.pc")
  foreach(file ${descriptions})
    file(READ ${file} text)
    string(REPLACE "\${pcfiledir}/" "\${pcfiledir}/../" text "${text}")  # one folder deeper
    file(WRITE ${file} "${text}")
  endforeach()
endif()

if(EXISTS ${stage}/program/usr/bin/sunder-bench)
  file(WRITE ${stage}/program/usr/share/man/man1/sunder-bench.1 ".so man1/sunder.1\n")
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
file(GLOB_RECURSE manuals "${stage}/*/usr/share/man/*.1")
file(GLOB folders "${stage}/*/usr/share/doc/*")
foreach(folder ${folders})
  cmake_path(GET folder FILENAME package)
  if(EXISTS "${folder}/copyright")
    file(WRITE "${folder}/changelog" "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md of the sources.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
    list(APPEND manuals "${folder}/changelog")
  endif()
endforeach()
foreach(manual ${manuals})
  execute_process(COMMAND gzip -9n "${manual}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
